// Names that the recordings do not tell apart, where runs that they were not fitted to do.
#pragma once

#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/proof.h"

namespace odolab {

// Where an alternative predicts the recordings held out better than chance could make it, it takes the name's place:
// the model is fitted anew, and the name is no alternative any more. Where it predicts them worse, it is none. What
// happened once may be what comes back but did so once only in what was fitted: that, too, is asked, although it says
// less there. And of the forms in which a name fits as well the one is taken that makes them likelier. Does nothing
// where none were held out.
void choose_by_unseen(const Predictor& predictor, JointModel& joint, Selected& selected);

}  // namespace odolab
