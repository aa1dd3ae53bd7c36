// Linked vehicles in the planar physics, beside Box2D alone on bodies and joints of the same number.
#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include "physics/simulation.h"
#include "test/bench/real_time.h"

namespace odolab {
namespace {

// The yardstick: two bodies, four friction joints and a spring, nothing of ours around them.
void Box2dTwoTrucksAndALink(benchmark::State& state) {
  b2World world(b2Vec2(0.0f, 0.0f));
  b2Body* trucks[2];
  for (int i = 0; i < 2; ++i) {
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.allowSleep = false;
    definition.position.Set(static_cast<float>(-i), 0.0f);
    trucks[i] = world.CreateBody(&definition);
    b2MassData mass{50.0f, b2Vec2(0.0f, 0.0f), 3.0f};
    trucks[i]->SetMassData(&mass);
    for (const float y : {0.17f, -0.17f}) {
      definition.type = b2_kinematicBody;
      definition.position.Set(static_cast<float>(-i), y);
      b2Body* tread = world.CreateBody(&definition);
      tread->SetLinearVelocity(b2Vec2(0.2f, 0.0f));
      b2FrictionJointDef joint;
      joint.Initialize(tread, trucks[i], b2Vec2(static_cast<float>(-i), y));
      joint.maxForce = 150.0f;
      world.CreateJoint(&joint);
    }
  }
  b2DistanceJointDef link;
  link.Initialize(trucks[0], trucks[1], trucks[0]->GetPosition(), trucks[1]->GetPosition());
  link.minLength = 0.0f;
  link.maxLength = 10.0f;
  b2LinearStiffness(link.stiffness, link.damping, 2.0f, 0.7f, trucks[0], trucks[1]);
  world.CreateJoint(&link);
  step_on(state, world);
}
BENCHMARK(Box2dTwoTrucksAndALink)->Unit(benchmark::kMillisecond);

// range(0): 1 with ten bumps and a rough floor.
void ClapperOnItsRectangle(benchmark::State& state) {
  Scenario scenario;
  scenario.vehicle.kind = Clapper{};
  scenario.path = RectanglePath{};
  scenario.driving = {0.45, 0.3, 0.2, 0.25, 0.0, true};
  scenario.sensors.encoder_period_s = scenario.sensors.truth_period_s = 0.040;
  if (state.range(0) > 0) {
    scenario.floor.roughness.largest_height_m = 0.001;
    for (int i = 0; i < 10; ++i)
      scenario.floor.bumps.push_back({{0.5 + 0.5 * i, 0.0}, 0.5 * kPi, 2.0, 0.010, Under::right_wheel});
  }
  whole_runs(state, scenario);
  state.SetLabel(state.range(0) > 0 ? "rough floor, ten cables" : "smooth floor");
}
BENCHMARK(ClapperOnItsRectangle)->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void ThreeCastorsOnASquare(benchmark::State& state) {
  Scenario scenario;
  scenario.vehicle.kind = three_castor_vehicle();
  scenario.path = SquarePath{1.5, false};
  scenario.driving = {0.33, 0.75, 0.2, 1.0, 0.0, true};
  scenario.sensors.encoder_period_s = scenario.sensors.truth_period_s = 0.050;
  whole_runs(state, scenario);
}
BENCHMARK(ThreeCastorsOnASquare)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace odolab
