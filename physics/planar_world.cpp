#include "physics/planar_world.h"

#include <box2d/box2d.h>

#include "physics/planar_world_solver.h"

// Box2D reads the clock twice for each part of a step, for a profile that nobody reads here: a third of the time that a
// simulation takes. The program's own timer takes the place of the library's, where libraries are linked so.
#ifdef __linux__
b2Timer::b2Timer() : m_start_sec(0), m_start_usec(0) {}
void b2Timer::Reset() {}
float b2Timer::GetMilliseconds() const { return 0.0f; }
#endif

namespace odolab {

using namespace planar_world;

namespace {

// Impulses of two or three wheels settle in a few sweeps, and what is left over is taken up in the next step.
constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

b2Vec2 single(Vec2 v) { return {static_cast<float>(v.x_m), static_cast<float>(v.y_m)}; }
Vec2 twice(b2Vec2 v) { return {v.x, v.y}; }

}  // namespace

PlanarWorld::Solver::Solver(double step, Friction friction)
    : step_s(step), exact(friction), world(std::make_unique<b2World>(b2Vec2(0.0f, 0.0f))) {
  world->SetAllowSleeping(false);
  world->SetContinuousPhysics(false);
}

PlanarWorld::Solver::~Solver() = default;

// Moves two bodies, each the less the heavier it is, so that point b of body b comes to lie on point a of body a, or
// on the line through it. Linear in the small gap (README, Eq. 7).
void PlanarWorld::Solver::close_gap(const Rigid& joint) {
  Body& a = bodies[static_cast<std::size_t>(joint.a)];
  Body& b = bodies[static_cast<std::size_t>(joint.b)];
  const Vec2 ra = turned(joint.anchor_a, std::cos(a.pose.heading_rad), std::sin(a.pose.heading_rad));
  const Vec2 rb = turned(joint.anchor_b, std::cos(b.pose.heading_rad), std::sin(b.pose.heading_rad));
  const Vec2 gap = b.pose.position() + rb - a.pose.position() - ra;
  const double ma = 1.0 / a.mass_kg, mb = 1.0 / b.mass_kg;
  const double ia = 1.0 / a.inertia_kgm2, ib = 1.0 / b.inertia_kgm2;
  Vec2 impulse;  // on b, against it on a
  Vec2 arm_a = ra;
  if (joint.along_line) {
    const double across_rad = a.pose.heading_rad + joint.direction_rad + 0.5 * kPi;
    const Vec2 across{std::cos(across_rad), std::sin(across_rad)};
    arm_a = ra + gap;  // the line is fixed to a, and b's point lies somewhere on it
    const double ka = cross(arm_a, across), kb = cross(rb, across);
    impulse = (-dot(gap, across) / (ma + mb + ia * ka * ka + ib * kb * kb)) * across;
  } else {
    const double kxx = ma + mb + ia * ra.y_m * ra.y_m + ib * rb.y_m * rb.y_m;
    const double kxy = -ia * ra.x_m * ra.y_m - ib * rb.x_m * rb.y_m;
    const double kyy = ma + mb + ia * ra.x_m * ra.x_m + ib * rb.x_m * rb.x_m;
    const double det = kxx * kyy - kxy * kxy;
    impulse = {-(kyy * gap.x_m - kxy * gap.y_m) / det, -(kxx * gap.y_m - kxy * gap.x_m) / det};
  }
  a.pose = {a.pose.x_m - ma * impulse.x_m, a.pose.y_m - ma * impulse.y_m,
            a.pose.heading_rad - ia * cross(arm_a, impulse)};
  b.pose = {b.pose.x_m + mb * impulse.x_m, b.pose.y_m + mb * impulse.y_m, b.pose.heading_rad + ib * cross(rb, impulse)};
}

void PlanarWorld::Solver::add_spring(Spring spring, double frequency_hz, double damping_ratio) {
  const double ma = bodies[static_cast<std::size_t>(spring.a)].mass_kg;
  const double mb = bodies[static_cast<std::size_t>(spring.b)].mass_kg;
  const double mass_kg = ma * mb / (ma + mb), rate = 2.0 * kPi * frequency_hz;
  spring.stiffness_npm = mass_kg * rate * rate;
  spring.damping_nspm = 2.0 * mass_kg * damping_ratio * rate;
  springs.push_back(spring);
}

void PlanarWorld::Solver::take_forces() {
  solved_exactly = false;
  for (CoulombDrive& drive : drives) drive.added_mps = 0.0;
  const float inverse_step = 1.0f / static_cast<float>(step_s);
  for (Tread& tread : treads) {
    const Body& body = bodies[tread.body];
    tread.force_n = turned(twice(tread.joint->GetReactionForce(inverse_step)), body.cos_turn, -body.sin_turn);
  }
}

void PlanarWorld::Solver::solve_with_box2d() {
  const double h = step_s;
  // The frame of the solution: where body 0 will be at the middle of the step, moving with it (README, Eqs. 1, 2).
  const Body& lead = bodies[0];
  const double frame_rad = lead.pose.heading_rad + 0.5 * h * lead.yaw_rate_radps;
  const double c = std::cos(frame_rad), s = std::sin(frame_rad);
  const Vec2 frame_place = lead.pose.position() + (0.5 * h) * lead.velocity_mps;
  const Vec2 frame_velocity = turned(lead.velocity_mps, c, -s);
  const double frame_rate = lead.yaw_rate_radps;
  const auto frame_velocity_at = [&](Vec2 p) {
    return Vec2{frame_velocity.x_m - frame_rate * p.y_m, frame_velocity.y_m + frame_rate * p.x_m};
  };

  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& body = bodies[i];
    if (i > 0) {
      const Vec2 middle = body.pose.position() + (0.5 * h) * body.velocity_mps;
      body.place = turned(middle - frame_place, c, -s);
      body.turn_rad = body.pose.heading_rad + 0.5 * h * body.yaw_rate_radps - frame_rad;
      body.cos_turn = std::cos(body.turn_rad);
      body.sin_turn = std::sin(body.turn_rad);
    }
    body.solved->SetTransform(single(body.place), static_cast<float>(body.turn_rad));
    body.solved->SetLinearVelocity(single(turned(body.pushed_mps, c, -s) - frame_velocity_at(body.place)));
    body.solved->SetAngularVelocity(static_cast<float>(body.pushed_radps - frame_rate));
  }
  for (Tread& tread : treads) {
    const Body& body = bodies[tread.body];
    const Vec2 place = body.place + turned(tread.place, body.cos_turn, body.sin_turn);
    const Vec2 velocity = turned(tread.velocity_mps, body.cos_turn, body.sin_turn);
    tread.floor->SetTransform(single(place), 0.0f);
    tread.floor->SetLinearVelocity(single(velocity - frame_velocity_at(place)));
  }
  for (FreeWheel& wheel : free_wheels) {
    const Body& body = bodies[wheel.body];
    const Vec2 place = body.place + turned(wheel.place, body.cos_turn, body.sin_turn);
    wheel.floor->SetTransform(single(place), static_cast<float>(body.turn_rad + wheel.direction_rad));
    wheel.floor->SetLinearVelocity(single(-1.0 * frame_velocity_at(place)));
  }

  world->Step(static_cast<float>(h), kVelocityIterations, kPositionIterations);

  for (Body& body : bodies) {
    const Vec2 velocity = frame_velocity_at(body.place) + twice(body.solved->GetLinearVelocity());
    body.next_mps = turned(velocity, c, s);
    body.next_radps = frame_rate + body.solved->GetAngularVelocity();
    body.solved_at_rad = body.pose.heading_rad + 0.5 * h * body.yaw_rate_radps;
  }
}

PlanarWorld::PlanarWorld(double step_s, Friction exact) : solver_(std::make_unique<Solver>(step_s, exact)) {}
PlanarWorld::~PlanarWorld() = default;
PlanarWorld::PlanarWorld(PlanarWorld&&) noexcept = default;
PlanarWorld& PlanarWorld::operator=(PlanarWorld&&) noexcept = default;

int PlanarWorld::add_body(const BodyDefinition& definition) {
  b2BodyDef def;
  def.type = b2_dynamicBody;
  def.allowSleep = false;
  Solver::Body body;
  body.pose = definition.pose;
  body.mass_kg = definition.mass_kg;
  body.inertia_kgm2 = definition.moment_of_inertia_kgm2;
  body.solved = solver_->world->CreateBody(&def);
  b2MassData mass;
  mass.mass = static_cast<float>(definition.mass_kg);
  mass.I = static_cast<float>(definition.moment_of_inertia_kgm2);
  mass.center.SetZero();
  body.solved->SetMassData(&mass);
  solver_->bodies.push_back(body);
  return static_cast<int>(solver_->bodies.size()) - 1;
}

int PlanarWorld::add_tread(int body, Vec2 place) {
  b2BodyDef def;
  def.type = b2_kinematicBody;
  def.allowSleep = false;
  Solver::Tread tread;
  tread.body = body;
  tread.place = place;
  tread.floor = solver_->world->CreateBody(&def);
  b2FrictionJointDef joint;
  joint.bodyA = tread.floor;
  joint.bodyB = solver_->bodies[body].solved;
  joint.localAnchorA.SetZero();
  joint.localAnchorB = single(place);
  joint.maxForce = 0.0f;
  joint.maxTorque = 0.0f;
  tread.joint = static_cast<b2FrictionJoint*>(solver_->world->CreateJoint(&joint));
  solver_->treads.push_back(tread);
  return static_cast<int>(solver_->treads.size()) - 1;
}

void PlanarWorld::add_spring(const SpringDefinition& d) {
  b2Body* a = solver_->bodies[d.body_a].solved;
  b2Body* b = solver_->bodies[d.body_b].solved;
  b2DistanceJointDef joint;
  joint.bodyA = a;
  joint.bodyB = b;
  joint.localAnchorA = single(d.anchor_a);
  joint.localAnchorB = single(d.anchor_b);
  joint.length = static_cast<float>(d.rest_length_m);
  joint.minLength = 0.0f;
  joint.maxLength = static_cast<float>(10.0 * d.rest_length_m);
  joint.collideConnected = true;
  b2LinearStiffness(joint.stiffness, joint.damping, static_cast<float>(d.frequency_hz),
                    static_cast<float>(d.damping_ratio), a, b);
  solver_->world->CreateJoint(&joint);
  Solver::Spring spring{d.body_a, d.body_b, d.anchor_a, d.anchor_b, false, 0.0, d.rest_length_m, 0.0, 0.0};
  solver_->add_spring(spring, d.frequency_hz, d.damping_ratio);
}

void PlanarWorld::add_pin(const PinDefinition& d) {
  b2RevoluteJointDef joint;
  joint.bodyA = solver_->bodies[d.body_a].solved;
  joint.bodyB = solver_->bodies[d.body_b].solved;
  joint.localAnchorA = single(d.anchor_a);
  joint.localAnchorB = single(d.anchor_b);
  joint.collideConnected = true;
  solver_->world->CreateJoint(&joint);
  solver_->rigid_joints.push_back({d.body_a, d.body_b, d.anchor_a, d.anchor_b, false, 0.0});
}

void PlanarWorld::add_slider(const SliderDefinition& d) {
  b2WheelJointDef joint;
  joint.bodyA = solver_->bodies[d.body_a].solved;
  joint.bodyB = solver_->bodies[d.body_b].solved;
  joint.localAnchorA = single(d.anchor_a);
  joint.localAnchorB = single(d.anchor_b);
  joint.localAxisA = single({std::cos(d.direction_rad), std::sin(d.direction_rad)});
  joint.enableMotor = false;
  joint.collideConnected = true;
  if (d.frequency_hz > 0.0)
    b2LinearStiffness(joint.stiffness, joint.damping, static_cast<float>(d.frequency_hz),
                      static_cast<float>(d.damping_ratio), joint.bodyA, joint.bodyB);
  solver_->world->CreateJoint(&joint);
  solver_->rigid_joints.push_back({d.body_a, d.body_b, d.anchor_a, d.anchor_b, true, d.direction_rad});
  if (d.frequency_hz > 0.0)
    solver_->add_spring({d.body_a, d.body_b, d.anchor_a, d.anchor_b, true, d.direction_rad, 0.0, 0.0, 0.0},
                        d.frequency_hz, d.damping_ratio);
}

int PlanarWorld::add_free_wheel(int body, Vec2 place, double direction_rad) {
  b2BodyDef def;
  def.type = b2_kinematicBody;
  def.allowSleep = false;
  Solver::FreeWheel wheel;
  wheel.body = body;
  wheel.place = place;
  wheel.direction_rad = direction_rad;
  wheel.floor = solver_->world->CreateBody(&def);
  b2WheelJointDef joint;
  joint.bodyA = wheel.floor;
  joint.bodyB = solver_->bodies[body].solved;
  joint.localAnchorA.SetZero();
  joint.localAnchorB = single(place);
  joint.localAxisA = {1.0f, 0.0f};
  wheel.joint = static_cast<b2WheelJoint*>(solver_->world->CreateJoint(&joint));
  solver_->free_wheels.push_back(wheel);
  return static_cast<int>(solver_->free_wheels.size()) - 1;
}

void PlanarWorld::set_tread(int tread, Vec2 velocity_mps, double grip_n) {
  solver_->treads[tread].velocity_mps = velocity_mps;
  solver_->treads[tread].grip_n = grip_n;
  solver_->treads[tread].drive = -1;
  solver_->treads[tread].joint->SetMaxForce(static_cast<float>(grip_n));
}

int PlanarWorld::add_drive(int body) {
  CoulombDrive drive;
  drive.body = body;
  solver_->drives.push_back(drive);
  return static_cast<int>(solver_->drives.size()) - 1;
}

void PlanarWorld::set_drive(int drive, double inertia_kg, double free_change_mps) {
  solver_->drives[drive].inertia_kg = inertia_kg;
  solver_->drives[drive].free_mps = free_change_mps;
}

void PlanarWorld::set_tread_drive(int tread, int drive, Vec2 direction) {
  solver_->treads[tread].drive = drive;
  solver_->treads[tread].drive_direction = direction;
}

double PlanarWorld::drive_change_mps(int drive) const { return solver_->drives[drive].added_mps; }
void PlanarWorld::soften_friction(double slip_mps) { solver_->sliding.softness_mps = slip_mps; }
bool PlanarWorld::solved_exactly() const { return solver_->solved_exactly; }

void PlanarWorld::set_velocity(int body, Vec2 velocity_mps, double yaw_rate_radps) {
  solver_->bodies[body].velocity_mps = velocity_mps;
  solver_->bodies[body].yaw_rate_radps = yaw_rate_radps;
}

void PlanarWorld::apply_force(int body, Vec2 force_n, double torque_nm) {
  solver_->bodies[body].force_n = solver_->bodies[body].force_n + force_n;
  solver_->bodies[body].torque_nm += torque_nm;
}

void PlanarWorld::step() {
  const double h = solver_->step_s;
  std::vector<Solver::Body>& bodies = solver_->bodies;
  for (Solver::Body& body : bodies) {
    body.pushed_mps = body.velocity_mps + (h / body.mass_kg) * body.force_n;
    body.pushed_radps = body.yaw_rate_radps + h / body.inertia_kgm2 * body.torque_nm;
    body.force_n = {};
    body.torque_nm = 0.0;
  }
  if (solver_->exact == Friction::in_every_step) {
    for (Solver::Body& body : bodies) {
      body.next_mps = body.pushed_mps + body.inner_mps;
      body.next_radps = body.pushed_radps + body.inner_radps;
    }
    solver_->solve_sliding();
  } else {
    // A wheel that begins to hold is given one step more, so that Box2D takes over a settled motion.
    solver_->solve_with_box2d();
    if (solver_->slides || solver_->any_wheel_slides())
      solver_->solve_sliding();
    else
      solver_->take_forces();
  }
  for (Solver::Body& body : bodies) {
    body.inner_mps = body.next_mps - body.pushed_mps;
    body.inner_radps = body.next_radps - body.pushed_radps;
    body.velocity_mps = body.next_mps;
    body.yaw_rate_radps = body.next_radps;
    body.middle_rad = body.pose.heading_rad + 0.5 * h * body.yaw_rate_radps;
    const double correction_rad = body.middle_rad - body.solved_at_rad;  // to the middle heading as it came out (Eq. 4)
    const Vec2 travel = h * turned(body.velocity_mps, 1.0, correction_rad);
    body.pose = {body.pose.x_m + travel.x_m, body.pose.y_m + travel.y_m,
                 body.pose.heading_rad + h * body.yaw_rate_radps};
  }
  // Joints that share a body open each other's gaps a little; a second sweep closes those.
  const int sweeps = solver_->rigid_joints.size() > 1 ? 2 : 1;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const Solver::Rigid& joint : solver_->rigid_joints) solver_->close_gap(joint);
}

const Pose& PlanarWorld::pose(int body) const { return solver_->bodies[body].pose; }
Vec2 PlanarWorld::velocity_mps(int body) const { return solver_->bodies[body].velocity_mps; }
double PlanarWorld::yaw_rate_radps(int body) const { return solver_->bodies[body].yaw_rate_radps; }
Vec2 PlanarWorld::tread_force_n(int tread) const { return solver_->treads[tread].force_n; }


Vec2 PlanarWorld::velocity_of_point_mps(int body, Vec2 place) const {
  const Solver::Body& b = solver_->bodies[static_cast<std::size_t>(body)];
  const Vec2 v = rotated(b.velocity_mps, -b.middle_rad);
  return {v.x_m - b.yaw_rate_radps * place.y_m, v.y_m + b.yaw_rate_radps * place.x_m};
}

}  // namespace odolab
