// A small application for applicationTest: reads a dictionary, and fails as it is told.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "core/application.hpp"

using namespace corpuscle;

int main(int argc, char* argv[]) {
    std::vector<Option> options = solverOptions();
    options.push_back({"fail", "HOW", "How to fail."});
    Application app("sample", "A sample.", argc, argv, {.options = options, .samples = {"sample -steps 3"}});
    return app.run([&] {
        const std::string how = app.value("fail").value_or("");
        const int last = app.communicator().size() - 1;
        if (how == "numerics") throw Failure(ExitCode::numerics, "NaN in step 3");
        if (how == "one" && app.communicator().rank() == last) throw Failure(ExitCode::io, "the disk is full");
        if (how == "one") app.communicator().barrier();
        if (how == "stopped") return ExitCode::stopped;
        Problems problems;
        const Node control = app.dictionary("system/control.yaml", problems);
        problems.throwIfAny();
        app.openLog();
        app.log().info("steps {}", app.integer("steps").value_or(-1));
        if (app.communicator().isRoot()) std::fputs(emit(control).c_str(), stdout);
        return ExitCode::done;
    });
}
