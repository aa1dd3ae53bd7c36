#include "core/diagnosis/naming/shape_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/diagnosis/diagnosis.h"
#include "test/support/calibrated_model.h"
#include "test/support/missing_physics.h"
#include "test/support/other_room.h"

namespace odolab::test {
namespace {

const Effect& patch() {
  for (const Effect& e : catalogue())
    if (e.name == "slip_zone") return e;
  return catalogue().front();
}

// The places that are scanned stand on a grid along the room's axes; how these lie says nothing of the floor.
TEST(ShapeSearch, FindsAPatchAsWellHoweverTheRoomIsTurned) {
  CaseSettings settings;
  settings.effect = "slip_zone";
  settings.size = 0.15;
  settings.runs = 4;
  const Case c = generated_case(settings, 21);
  double least = 1e300, most = 0.0;
  for (const double by_rad : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.4}) {
    std::vector<Recording> turned = c.recordings;
    for (Recording& r : turned) r = in_room(std::move(r), {0.0, 0.0, by_rad});
    const JointModel joint = calibrated_model(turned, c.nominal);
    const CandidateScan scan(joint, JointModel::kNone);
    const double found = best_shape(joint.views(), scan, patch()).best.statistic;
    least = std::min(least, found), most = std::max(most, found);
  }
  EXPECT_GT(most, 30.0);          // it is there
  EXPECT_GT(least, 0.93 * most);  // rims are sharp: readings come on one side of them or on the other
}

}  // namespace
}  // namespace odolab::test
