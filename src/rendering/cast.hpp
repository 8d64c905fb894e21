#pragma once

#include <memory>
#include <vector>

#include "rendering/light_probes.hpp"
#include "rendering/moving_things.hpp"
#include "rendering/person.hpp"
#include "rendering/prop.hpp"

namespace stdc {

/// Everybody and everything that moves in a sequence.
class Cast {
 public:
  /// `world` must outlive this.
  Cast(const World& world, const BakedLight& light, std::vector<Person> people, std::vector<Prop> props)
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
