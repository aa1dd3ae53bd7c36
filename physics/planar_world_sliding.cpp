// The steps of a planar world in which some wheel slides, solved in double with exact friction: README, "Contacts that
// slide".
#include <box2d/box2d.h>

#include "physics/planar_world_solver.h"

namespace odolab {

using namespace planar_world;

namespace {

// Box2D cuts a force to the grip in single precision.
constexpr double kAllOfTheGrip = 1.0 - 1e-4;
// The backward difference of second order: of this step's forces, and of the last one's effect (README, Eq. 12).
constexpr double kNew = 2.0 / 3.0, kOld = 1.0 / 3.0;

}  // namespace

bool PlanarWorld::Solver::any_wheel_slides() const {
  const float inverse_step = 1.0f / static_cast<float>(step_s);
  for (const Tread& tread : treads) {
    const double bound_n = kAllOfTheGrip * tread.grip_n;
    const b2Vec2 single_n = tread.joint->GetReactionForce(inverse_step);
    const Vec2 force_n{single_n.x, single_n.y};
    if (tread.grip_n > 0.0 && dot(force_n, force_n) >= bound_n * bound_n) return true;
  }
  return false;
}

void PlanarWorld::Solver::solve_sliding() {
  const double h = step_s;
  // Where everything will be in the middle of the step, by the forces of the last.
  struct Middle {
    Vec2 place;
    double cos_heading, sin_heading;
    Vec2 of(Vec2 in_body) const { return turned(in_body, cos_heading, sin_heading); }
  };
  std::vector<Middle> middles;
  sliding.bodies.clear();
  sliding.contacts.clear();
  sliding.links.clear();
  sliding.drives = drives;
  for (Body& body : bodies) {
    const Vec2 velocity = body.pushed_mps + body.inner_mps;
    body.solved_at_rad = body.pose.heading_rad + 0.5 * h * (body.pushed_radps + body.inner_radps);
    middles.push_back(
        {body.pose.position() + (0.5 * h) * velocity, std::cos(body.solved_at_rad), std::sin(body.solved_at_rad)});
    sliding.bodies.push_back({body.mass_kg, body.inertia_kgm2, body.pushed_mps + kOld * body.inner_mps,
                              body.pushed_radps + kOld * body.inner_radps, body.next_mps, body.next_radps});
  }
  const auto at = [&](int body) -> const Middle& { return middles[static_cast<std::size_t>(body)]; };

  for (const Tread& tread : treads) {
    CoulombContact contact;
    contact.body = tread.body;
    contact.arm = at(tread.body).of(tread.place);
    contact.surface_mps = at(tread.body).of(tread.velocity_mps);
    contact.grip_ns = kNew * h * tread.grip_n;
    if (tread.drive >= 0) {
      CoulombDrive& drive = sliding.drives[static_cast<std::size_t>(tread.drive)];
      contact.drive = tread.drive;
      contact.direction = at(tread.body).of(tread.drive_direction);
      drive.free_mps -= kOld * h * dot(tread.force_n, tread.drive_direction) / drive.inertia_kg;
    }
    sliding.contacts.push_back(contact);
  }
  for (const FreeWheel& wheel : free_wheels) {
    const Vec2 across = at(wheel.body).of({-std::sin(wheel.direction_rad), std::cos(wheel.direction_rad)});
    sliding.links.push_back({-1, wheel.body, across, {}, at(wheel.body).of(wheel.place), CoulombLink::rigid_kg});
  }
  for (const Rigid& joint : rigid_joints) {
    const Vec2 ra = at(joint.a).of(joint.anchor_a), rb = at(joint.b).of(joint.anchor_b);
    if (joint.along_line) {
      const Vec2 across = at(joint.a).of({-std::sin(joint.direction_rad), std::cos(joint.direction_rad)});
      const Vec2 arm_a = at(joint.b).place + rb - at(joint.a).place;
      sliding.links.push_back({joint.a, joint.b, across, arm_a, rb, CoulombLink::rigid_kg});
    } else {
      sliding.links.push_back({joint.a, joint.b, {1.0, 0.0}, ra, rb, CoulombLink::rigid_kg});
      sliding.links.push_back({joint.a, joint.b, {0.0, 1.0}, ra, rb, CoulombLink::rigid_kg});
    }
  }
  for (const Spring& spring : springs) {
    const Vec2 ra = at(spring.a).of(spring.anchor_a), rb = at(spring.b).of(spring.anchor_b);
    const Vec2 apart = at(spring.b).place + rb - at(spring.a).place - ra;
    CoulombLink link{spring.a, spring.b, {}, ra, rb};
    const Body& a = bodies[static_cast<std::size_t>(spring.a)];
    const Body& b = bodies[static_cast<std::size_t>(spring.b)];
    const auto begin_of = [](const Body& body, Vec2 anchor) {
      return body.pose.position() + rotated(anchor, body.pose.heading_rad);
    };
    const Vec2 apart_at_begin = begin_of(b, spring.anchor_b) - begin_of(a, spring.anchor_a);
    double stretch_m = 0.0;  // at the step's begin; half a step of its growth is added to it
    if (spring.along_line) {
      link.direction = at(spring.a).of({std::cos(spring.direction_rad), std::sin(spring.direction_rad)});
      link.arm_a = ra + apart;
      const double line_rad = a.pose.heading_rad + spring.direction_rad;
      stretch_m = dot(apart_at_begin, {std::cos(line_rad), std::sin(line_rad)});
    } else {
      link.direction = (1.0 / length(apart)) * apart;
      stretch_m = length(apart_at_begin) - spring.rest_length_m;
    }
    link.resistance_kg = kNew * h * (spring.damping_nspm + 0.5 * h * spring.stiffness_npm);
    link.bias_ns = kNew * h * spring.stiffness_npm * stretch_m;
    sliding.links.push_back(link);
  }

  sliding.solve();

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].next_mps = sliding.bodies[i].velocity_mps;
    bodies[i].next_radps = sliding.bodies[i].yaw_rate_radps;
  }
  slides = false;
  solved_exactly = true;
  for (std::size_t i = 0; i < treads.size(); ++i) {
    const Middle& body = at(treads[i].body);
    const CoulombContact& contact = sliding.contacts[i];
    treads[i].force_n =
        kOld * treads[i].force_n + turned((1.0 / h) * contact.impulse_ns, body.cos_heading, -body.sin_heading);
    slides = slides || length(contact.impulse_ns) > kAllOfTheGrip * contact.grip_ns;
  }
  for (std::size_t i = 0; i < drives.size(); ++i) drives[i].added_mps = sliding.drives[i].added_mps;
}

}  // namespace odolab
