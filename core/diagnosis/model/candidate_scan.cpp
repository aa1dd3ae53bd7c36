#include "core/diagnosis/model/candidate_scan.h"

#include "core/diagnosis/model/scanned_products.h"

namespace odolab {

CandidateScan::CandidateScan(const JointModel& joint, int without)
    : joint_(joint), without_(without), absorbing_(joint.absorbing(without)), products_(joint.scanned_products()) {}

CandidateTest CandidateScan::test(const Effect& effect, const std::vector<double>& shape) const {
  return std::move(tests(effect, {shape}).front());
}

std::vector<CandidateTest> CandidateScan::tests(const Effect& effect,
                                                const std::vector<std::vector<double>>& shapes) const {
  std::vector<CandidateTest> results(shapes.size());
  std::vector<std::size_t> asked;
  std::vector<const std::vector<double>*> of;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (effect.of_one_recording && !joint_.is_well_inside(static_cast<int>(shapes[i][0]), shapes[i][1])) continue;
    if (effect.clock_rate) {
      results[i] = joint_.test(joint_.columns_of(effect, shapes[i]), without_);
      continue;
    }
    asked.push_back(i);
    of.push_back(&shapes[i]);
  }
  std::vector<ScannedProducts::OfShape> products = products_->of(effect, of);
  for (std::size_t k = 0; k < asked.size(); ++k)
    if (products[k].acts)
      results[asked[k]] = JointModel::tested(absorbing_, std::move(products[k].products), AskedHow{}, nullptr);
  return results;
}

}  // namespace odolab
