#pragma once

#include <memory>
#include <vector>

#include "simulation/light/light_probes.hpp"
#include "simulation/light/moving_objects.hpp"
#include "simulation/people/person.hpp"
#include "simulation/scene/prop.hpp"

namespace stdc::simulation {

/// All people and objects that move in a sequence.
class DynamicScene {
 public:
  /// `world` must outlive this.
  DynamicScene(const World& world, const BakedLight& light, std::vector<Person> people,
               std::vector<Prop> props)
      : world_(world), probes_(world, light), people_(std::move(people)), props_(std::move(props)) {}

  /// Their state at `time` [s]; null if there are none. The result refers to this object. Thread-safe.
  std::unique_ptr<MovingObjects> at(double time) const;

  /// Whether there is a prop that moves at some time.
  bool has_moving_props() const;
  const std::vector<Person>& people() const { return people_; }
  const std::vector<Prop>& props() const { return props_; }

 private:
  const World& world_;
  LightProbes probes_;
  std::vector<Person> people_;
  std::vector<Prop> props_;
};

}  // namespace stdc::simulation
