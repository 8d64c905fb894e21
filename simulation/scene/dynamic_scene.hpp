#pragma once

#include <memory>
#include <vector>

#include "simulation/light/light_probes.hpp"
#include "simulation/people/person.hpp"
#include "simulation/scene/moving_things.hpp"
#include "simulation/scene/prop.hpp"

namespace stdc {

/// Everybody and everything that moves in a sequence.
class DynamicScene {
 public:
  /// `world` must outlive this.
  DynamicScene(const World& world, const BakedLight& light, std::vector<Person> people,
               std::vector<Prop> props)
      : world_(world), probes_(world, light), people_(std::move(people)), props_(std::move(props)) {}

  /// All of them at a time [s]. The result refers to this object. Thread-safe.
  std::unique_ptr<MovingThings> at(double time) const;

  const std::vector<Person>& people() const { return people_; }
  const std::vector<Prop>& props() const { return props_; }

 private:
  const World& world_;
  LightProbes probes_;
  std::vector<Person> people_;
  std::vector<Prop> props_;
};

}  // namespace stdc
