// A scheme defined in this file alone: it has a name, a table of settings and an entry in every list, and it makes
// steps.
#include "numerics.hpp"
#include "schemes/cost.hpp"
#include "schemes/stepper.hpp"

namespace corpuscle::schemes {
namespace {

class DriftStepper final : public Stepper {
  public:
    DriftStepper(coupling::Scene& scene, double dt) : scene_(scene), dt_(dt) {}
    void start() override {}
    std::vector<double> state() const override { return {drifted_}; }
    std::size_t stateSize() const override { return 1; }
    void resume(const std::vector<double>& state) override { drifted_ = state.at(0); }
    double advance(double dt, double /*planned*/) override {
        drifted_ += dt;
        scene_.spacing += dt;
        return dt;
    }
    bool limitsChange(long /*step*/) override { return false; }
    sph::StepLimits limits(double /*t*/) override {
        sph::StepLimits limits;
        limits.add("drift", dt_);
        return limits;
    }

  private:
    coupling::Scene& scene_;
    double dt_, drifted_ = 0;
};

struct Drift final : Scheme {
    double factor = 0;
    static const Schema<Drift>& schema() {
        static const Schema<Drift> s =
            Schema<Drift>("drift", "particles that go on as they go")
                .quantity("factor", &Drift::factor, unit::none, "of the step", {.fallback = "2", .range = positive});
        return s;
    }
    Traits traits() const override { return {.stepKey = "drift.factor", .state = "drift"}; }
    void check(const CaseFacts& facts, const NumericsSettings&, Problems& problems) const override {
        if (facts.hasCells)
            problems.add({"system/numerics.yaml", 0, 0}, "integrator",
                         "found drift, which ignores cells; write implicit");
    }
    std::vector<UnusedKey> unused(const NumericsSettings&) const override {
        return {{"safety", "with 'integrator: drift'"}};
    }
    sph::StepLimits limits(const CaseFacts&, const NumericsSettings&, double /*t*/) const override {
        sph::StepLimits limits;
        limits.add("drift", 1e-6 * factor);
        return limits;
    }
    double passes(const CaseFacts&, const NumericsSettings&, double /*dt*/) const override { return 1e-9; }
    std::unique_ptr<Stepper> stepper(const CaseFacts&, const NumericsSettings&, coupling::Scene& scene) const override {
        return std::make_unique<DriftStepper>(scene, 1e-6 * factor);
    }
};
CORPUSCLE_REGISTER(Scheme, Drift, "drift", "particles that go on as they go");

TEST(OwnScheme, isChosenByItsNameAndHasItsTable) {
    const WrittenNumerics n("integrator: drift\ndrift: {factor: 3}\n");
    const NumericsSettings s = n.settled(n.settings.integrator);
    coupling::Scene scene;
    const auto stepper = s.scheme->stepper(n.facts, s, scene);
    EXPECT_DOUBLE_EQ(stepper->limits(0).binding().seconds, 3e-6);
    stepper->advance(2e-6, 3e-6);
    EXPECT_DOUBLE_EQ(scene.spacing, 2e-6);
    EXPECT_DOUBLE_EQ(stepper->state().at(0), 2e-6);
    EXPECT_EQ(write(s).find("drift")->find("factor")->scalar, "3");
    EXPECT_DOUBLE_EQ(dynamic_cast<const Drift&>(*WrittenNumerics("").settled("drift").scheme).factor, 2);
    EXPECT_THROW(WrittenNumerics("drift: {factors: 3}\n"), CaseError);
}

TEST(OwnScheme, isInEveryList) {
    WrittenNumerics n("");
    n.flow(100, 1e-3);
    const std::vector<IntegratorCost> costs = predictCosts(n.settings, n.facts);
    EXPECT_EQ(cheapest(costs), "drift");
    n.facts.hasCells = true;
    for (const IntegratorCost& cost : predictCosts(n.settings, n.facts))
        if (cost.name == "drift") {
            EXPECT_EQ(cost.whyNot, "found drift, which ignores cells");
        }
    const SchemaInfo info = NumericsSettings::schema().info();
    const auto field = [&](const std::string& key) {
        return *std::find_if(info.fields.begin(), info.fields.end(), [&](const FieldInfo& f) { return f.key == key; });
    };
    EXPECT_EQ(field("drift").atRestart, AtRestart::noted);
    const std::vector<std::string> words = field("integrator").words;
    EXPECT_NE(std::find(words.begin(), words.end(), "drift"), words.end());
}

TEST(OwnScheme, saysWhichKeysItDoesNotUse) {
    const WrittenNumerics n("safety: 0.5\n");
    Problems problems;
    check(n.settled("drift"), n.settings, n.facts, problems);
    EXPECT_EQ(problems.count(), 1u);
}

}  // namespace
}  // namespace corpuscle::schemes
