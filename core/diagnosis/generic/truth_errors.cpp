#include "core/diagnosis/generic/truth_errors.h"

#include "core/base/parallel.h"

namespace odolab {

namespace {

bool says_enough(const TruthError& error, const CandidateTest& test) {
  return !test.value.empty() && test.judged() > kLeastOfJoinedBodies + 2.0 * test.freedom &&
         error.is_more_than_rounding(test.value);
}

}  // namespace

std::vector<GenericTest> truth_error_tests(const AskedModel& asked, double looked_at) {
  if (!asked.joint.truth_errors) return {};
  const std::vector<TruthError>& errors = *asked.joint.truth_errors;
  std::vector<GenericTest> tests(errors.size());
  parallel_for(static_cast<int>(errors.size()), [&](int i) {
    const TruthError& error = errors[static_cast<std::size_t>(i)];
    GenericTest& t = tests[static_cast<std::size_t>(i)];
    t.variable = error.variable;
    t.channel = error.channel;
    t.component = error.component;
    t.curves = error.curves;
    ask(t, asked, error.term, looked_at);
    for (CandidateTest* test : {&t.test, &t.instead})
      if (!says_enough(error, *test)) test->statistic = 0.0;
    t.p_value = t.p_value_of(t.test);
  });
  return tests;
}

}  // namespace odolab
