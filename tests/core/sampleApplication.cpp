// A small program for the tests in application.cpp: reads a dictionary, and fails in the way it is told to.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "core/application.hpp"
#include "core/together.hpp"

using namespace corpuscle;

int main(int argc, char* argv[]) {
    std::vector<Option> options = solverOptions();
    options.push_back({"fail", "HOW", "How to fail."});
    Application app("sample", "A sample.", argc, argv, {.options = options, .samples = {"sample -steps 3"}});
    return app.run([&] {
        const std::string how = app.value("fail").value_or("");
        const int last = app.communicator().size() - 1;
        const auto record = std::make_shared<RunRecord>(app.path("run.json"), app.name(), app.communicator());
        record->write();
        app.keepRecord(record);
        if (how == "memory") return std::vector<double>(std::size_t{1} << 55).empty() ? ExitCode::done : ExitCode::io;
        if (how == "memoryTogether")
            together(app.communicator().handle(), [&] {
                if (app.communicator().rank() == last) throw std::bad_alloc();
            });
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
