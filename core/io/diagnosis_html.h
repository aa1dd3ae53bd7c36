// A diagnosis as one HTML page with its pictures, for a person who did not make the recordings.
#pragma once

#include "core/diagnosis/diagnosis.h"
#include "core/io/report_html.h"

namespace odolab {

HtmlReport diagnosis_report(const Diagnosis& diagnosis);

}  // namespace odolab
