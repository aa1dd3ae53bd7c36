// How fast and how true the planar physics is. Counters: times_real_time = simulated per real second; the others are
// the errors that the tests hold against their bars.
#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include "physics/planar_world.h"
#include "physics/simulation.h"
#include "test/bench/real_time.h"

namespace odolab {
namespace {

// The yardstick: Box2D itself on one body with two friction joints, nothing of ours around it.
void Box2dOneBodyTwoWheels(benchmark::State& state) {
  b2World world(b2Vec2(0.0f, 0.0f));
  b2BodyDef definition;
  definition.type = b2_dynamicBody;
  definition.allowSleep = false;
  b2Body* body = world.CreateBody(&definition);
  b2MassData mass{50.0f, b2Vec2(0.0f, 0.0f), 3.0f};
  body->SetMassData(&mass);
  for (const float y : {0.17f, -0.17f}) {
    definition.type = b2_kinematicBody;
    definition.position.Set(0.0f, y);
    b2Body* tread = world.CreateBody(&definition);
    tread->SetLinearVelocity(b2Vec2(0.2f, 0.0f));
    b2FrictionJointDef joint;
    joint.Initialize(tread, body, b2Vec2(0.0f, y));
    joint.maxForce = 150.0f;
    world.CreateJoint(&joint);
  }
  step_on(state, world);
}
BENCHMARK(Box2dOneBodyTwoWheels)->Unit(benchmark::kMillisecond);

// The LabMate with motors, encoders, dead reckoning, driver and truth on its square; range(0): what lies on the floor.
void LabMateOnItsSquare(benchmark::State& state) {
  Scenario scenario;
  if (state.range(0) >= 1) scenario.floor.roughness.largest_height_m = 0.001;
  if (state.range(0) >= 2)
    for (int i = 1; i <= 10; ++i)
      scenario.floor.bumps.push_back({{0.36 * i, 0.0}, 0.5 * kPi, 1.5, 0.010, Under::inside_wheel});
  whole_runs(state, scenario);
  state.SetLabel(state.range(0) == 0   ? "smooth floor"
                 : state.range(0) == 1 ? "rough floor"
                                       : "rough floor, ten cables");
}
BENCHMARK(LabMateOnItsSquare)->Arg(0)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);

// 200 m straight at 1 ms, range(0) metres away from the origin: how far the end is from the closed form.
void StraightAgainstClosedForm(benchmark::State& state) {
  Scenario scenario;
  scenario.motor.ideal = true;
  const double away_m = static_cast<double>(state.range(0));
  scenario.start = {away_m, away_m, 0.7};
  scenario.path = WheelSpeedPath{{{400.0, 0.5 / 0.075, 0.5 / 0.075}}, 0.5};
  double error_m = 0.0;
  for (auto _ : state) {
    Simulation simulation(scenario, 1);
    run_to_end(simulation);
    error_m = length(simulation.state().true_pose.position() - scenario.start * Vec2{200.0, 0.0});
  }
  state.counters["error_mm"] = 1e3 * error_m;
}
BENCHMARK(StraightAgainstClosedForm)->Arg(0)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(1);

// Two 30 kg trucks on a link with a 2 Hz spring, the rear one 1 % faster over 4 m; range(0): the step in ms. 40.0 mm.
void LinkOfTwoTrucks(benchmark::State& state) {
  const double h = 1e-3 * static_cast<double>(state.range(0));
  double shortening_m = 0.0;
  std::int64_t steps = 0;
  for (auto _ : state) {
    PlanarWorld world(h);
    const int front = world.add_body({{0.0, 0.0, 0.0}, 30.0, 2.0});
    const int rear = world.add_body({{-1.0, 0.0, 0.0}, 30.0, 2.0});
    std::vector<int> treads;
    for (const int body : {front, rear})
      for (const double side : {0.17, -0.17}) treads.push_back(world.add_tread(body, {0.0, side}));
    world.add_spring({front, rear, {}, {}, 1.0, 2.0, 0.7});
    for (double way_m = 0.0; way_m < 4.0 - 1e-9; ++steps) {
      const double v = std::min(0.3 * std::min(1.0, way_m / 0.1 + 0.01), (4.0 - way_m) / h);
      way_m += v * h;
      for (std::size_t i = 0; i < 4; ++i) world.set_tread(treads[i], {i < 2 ? v : 1.01 * v, 0.0}, 150.0);
      world.step();
    }
    shortening_m = 1.0 - length(world.pose(front).position() - world.pose(rear).position());
  }
  state.counters["shortening_mm"] = 1e3 * shortening_m;
  state.counters["steps_per_s"] = benchmark::Counter(static_cast<double>(steps), benchmark::Counter::kIsRate);
}
BENCHMARK(LinkOfTwoTrucks)->Arg(1)->Arg(5)->Unit(benchmark::kMillisecond);

void OneBumpUnderOneWheel(benchmark::State& state) {
  Scenario scenario;
  scenario.motor.ideal = true;
  scenario.path = WheelSpeedPath{{{10.0, 0.2 / 0.075, 0.2 / 0.075}}, 0.5};
  scenario.floor.bumps.push_back({{1.0, 0.0}, 0.5 * kPi, 2.0, 0.010, Under::left_wheel});
  double heading_rad = 0.0;
  for (auto _ : state) {
    Simulation simulation(scenario, 1);
    run_to_end(simulation);
    heading_rad = simulation.state().true_pose.heading_rad;
  }
  state.counters["heading_deg"] = degrees(heading_rad);
}
BENCHMARK(OneBumpUnderOneWheel)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace odolab
