// Where an entry of the catalogue fits best: at which place, time or threshold, and in which form.
#pragma once

#include <vector>

#include "core/diagnosis/model/candidate_scan.h"

namespace odolab {

struct SearchedShapes {
  CandidateTest best;     // without inflation; a statistic of zero where nothing that is physical fits at all
  std::size_t tried = 1;  // shapes that were scanned, times forms
  std::vector<std::vector<double>> shapes;  // those scanned
  // Of all that could be tested, and the number of the shape that each belongs to.
  std::vector<double> statistics;
  std::vector<std::size_t> of_shape;
};

// `also_from`: places, without a form, from which it is looked for too, whatever the scan says of them. Between the
// points of the scan it is looked for only where one of them has a statistic that is `worth_refining`.
SearchedShapes best_shape(const std::vector<DriveView>& views, const CandidateScan& scan, const Effect& effect,
                          const std::vector<std::vector<double>>& also_from = {}, double worth_refining = 0.0);

bool is_a_patch(const Effect& effect);  // a disc of the floor: x, y and a radius

// Whether its amplitudes are such as there are, and of the form of that shape.
bool is_physical(const JointModel& joint, const Effect& effect, const std::vector<double>& value,
                 const std::vector<double>& shape);

// An accepted effect as it would be in another of its forms, all else as it is; a shape that follows its amplitude
// goes with it.
CandidateTest tested_in_form(const JointModel& joint, std::size_t accepted, std::size_t form);

// Two places: the square of how far they are apart, and their radii together; those without a radius are small.
struct Apart {
  double away_m2 = 0.0, radii_m = 0.0;
};
Apart apart(const Effect& effect, const std::vector<double>& shape, const std::vector<double>& other);

}  // namespace odolab
