// A cell's mesh that was moved into another after particleFill: checkMesh, checkCase and the solver each see it for
// themselves, on 1 and 2 ranks.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "io/polyData.hpp"
#include "io/temporaryFolder.hpp"

using namespace corpuscle;
namespace fs = std::filesystem;

namespace {

class MovedCell : public testing::TestWithParam<std::string> {  // integrator and coupling
  protected:
    struct Result {
        int code = 0;
        std::string err;
    };
    fs::path at(const std::string& inCase) const { return folder_.path() / inCase; }
    void write(const std::string& file, const std::string& text) const {
        fs::create_directories(at(file).parent_path());
        std::ofstream(at(file)) << text;
    }
    void SetUp() override {
        write("system/control.yaml", "application: dmpFlow\nendStrain: 1\n");
        write("system/numerics.yaml", "spacing: 1 um\nkernel: {type: wendlandC2, support: 2.4 dx}\n" + GetParam());
        write("system/mesh.yaml",
              "domain: {size: [12 um, 10 um, 10 um], periodic: [true, true, false]}\ncells:\n"
              "  - {name: a, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 1 um, centre: [-3 um, 0 um, 0 "
              "um]}\n"
              "  - {name: b, membrane: rbc, shape: {type: sphere, radius: 2 um}, edge: 1 um, centre: [3 um, 0 um, 0 "
              "um]}\n");
        write("constant/fluid.yaml", "density: 1000 kg/m^3\nviscosity: 1.0e-3 Pa s\n");
        write("constant/membranes.yaml", "rbc:\n  bonds: {type: harmonic, k: 5e-5 N/m}\n");
        write("constant/flow.yaml", "type: shear\nCa: 0.1\ninertia: {Re: 0.1}\n");
        ASSERT_EQ(run("membraneMesh").code, 0);
        ASSERT_EQ(run("particleFill").code, 0);
    }
    Result run(const std::string& program, const std::string& before = "") const {
        const std::string command = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " + before +
                                    " " PROGRAMS "/" + program + " -case " + folder_.path().string() + " > " +
                                    at("out.txt").string() + " 2> " + at("err.txt").string();
        const int status = std::system(command.c_str());
        std::ostringstream err;
        err << std::ifstream(at("err.txt")).rdbuf();
        return {WEXITSTATUS(status), err.str()};
    }
    void move(const Vec3& by) const {
        io::PolyData mesh = io::readVtp(at("0/b.vtp"));
        for (Vec3& x : mesh.points) x += by;
        io::writeVtp(at("0/b.vtp"), mesh);
    }
    void expectRefused(const std::string& words) const {
        for (const char* program : {"checkMesh", "checkCase", "dmpFlow"})
            for (const char* before : {"", "mpirun --oversubscribe -np 2"}) {
                if (program == std::string("checkMesh") && *before) continue;
                const Result result = run(program, before);
                EXPECT_EQ(result.code, 2) << program << ": " << result.err;
                const std::size_t first = result.err.find(words);
                ASSERT_NE(first, std::string::npos) << program << ": " << result.err;
                EXPECT_EQ(result.err.find(words, first + 1), std::string::npos) << "said once: " << result.err;
            }
        EXPECT_FALSE(fs::exists(at("checkpoints")));
    }

    TemporaryFolder folder_;
};

TEST_P(MovedCell, IntoAnother) {
    move({-3e-6, 0, 0});
    expectRefused("cells[1].centre: the cell 'a' and the cell 'b' overlap at (");
}
TEST_P(MovedCell, IntoAnotherThroughTheBoundary) {
    move({3e-6, 0, 0});
    expectRefused("cells[1].centre: the cell 'a' and the cell 'b' overlap at (");
}
TEST_P(MovedCell, ThroughAWall) {
    move({0, 0, 4e-6});
    expectRefused("cells[1].centre: the cell 'b' reaches from 2.");
}

INSTANTIATE_TEST_SUITE_P(couplings, MovedCell,
                         testing::Values("integrator: velocityVerlet\ncoupling: dualIdentity\n",
                                         "integrator: implicit\n"));

}  // namespace
