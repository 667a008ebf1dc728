// Observer `modelName`: the largest speed of the fluid; one file, modelName.csv.
#include <algorithm>

#include "core/communicator.hpp"
#include "observers/observer.hpp"

namespace corpuscle::observers {

namespace {

class ModelNameObservation : public Observation {
  public:
    using Observation::Observation;

    std::vector<Row> observe(const Scene& scene, const Time&) override {
        const particles::ParticleStore& s = scene.store();
        double largest = 0;
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.kindOf(i) == particles::Kind::fluid) largest = std::max(largest, s.velocity(i).norm());
        return {{0, {Communicator(scene.system->comm()).max(largest)}}};
    }
};

struct ModelNameObserver : Observer {
    static const Schema<ModelNameObserver>& schema() {
        static const Schema<ModelNameObserver> s =
            Schema<ModelNameObserver>("modelName", "largest speed of the fluid").include<ObserverSettings>();
        return s;
    }
    std::vector<Table> tables(const SceneParts&) const override {
        return {{"modelName", {{"largestSpeed", "m_s", "largest speed of a particle of the fluid"}}}};
    }
    std::unique_ptr<Observation> begin(const Scene& scene) const override {
        return std::make_unique<ModelNameObservation>(tables(SceneParts::of(scene)));
    }
};

CORPUSCLE_REGISTER(Observer, ModelNameObserver, "modelName", "largest speed of the fluid");

}  // namespace
}  // namespace corpuscle::observers
