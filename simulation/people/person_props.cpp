#include "simulation/people/person_props.hpp"

#include <cmath>

#include "simulation/scene/furniture.hpp"
#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {
namespace {

constexpr double kStep = 0.02;  // of the search for the time at which a push begins or ends [s]

}  // namespace

Prop carried_box(const Room& room, const PersonMotion& carrier) {
  Mesh mesh;
  ShapeBuilder builder(mesh, room.world.materials, 5);
  const auto side = [&](float u0, float u1) {
    return Finish{room.materials.cardboard.material, PictureArea{u0, 0.02F, u1, 0.98F}};
  };
  builder.box({0, 0, 0}, {kBoxSize[0], kBoxSize[1], kBoxSize[2]},
              {side(0.02F, 0.98F), side(0.02F, 0.42F), side(0.02F, 0.98F), side(0.58F, 0.98F),
               side(0.1F, 0.9F), side(0.1F, 0.4F)});
  std::vector<Prop::Move> moves;
  const auto held = [&](double t) { return carrier.held_box(t); };
  for (const Episode& e : carrier.route().episodes()) {
    if (e.act == Act::carry) moves.push_back(sampled_move(e.begin, e.end - 1e-6, held));
    if (e.act == Act::place) moves.push_back(sampled_move(e.begin, e.begin + kMovingBox, held));
    if (e.act == Act::pick) moves.push_back(sampled_move(e.end - kMovingBox, e.end, held));
  }
  const Pose start = moves.front().world_from_prop.front();
  return {std::move(mesh), start, std::move(moves), 0.18};
}

Prop pushed_chair(const Room& room, const PersonMotion& pusher, const Pose& start) {
  Mesh mesh;
  ShapeBuilder builder(mesh, room.world.materials, 6);
  add_office_chair(builder, room.materials);
  std::vector<Prop::Move> moves;
  Pose now = start;
  for (const Episode& e : pusher.route().episodes()) {
    if (e.act != Act::push) continue;
    const auto body = [&](double t) {
      const Stance s = pusher.route().at(t);
      return placed(s.position.x(), s.position.y(), 0, s.yaw);
    };
    // It moves while the person does.
    double first = e.begin, last = e.end;
    while (first < last && pusher.route().speed(first) < 0.01) first += kStep;
    while (last > first && pusher.route().speed(last) < 0.01) last -= kStep;
    const Pose body_from_chair = body(first).inverse() * now;
    moves.push_back(sampled_move(first, last, [&](double t) { return body(t) * body_from_chair; }));
    now = moves.back().world_from_prop.back();
  }
  return {std::move(mesh), start, std::move(moves), 0.25};
}

}  // namespace stdc::simulation
