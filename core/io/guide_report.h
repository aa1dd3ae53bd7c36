// A guide's session and what came of it as one page that needs no other file.
#pragma once

#include "core/guide/outcome.h"
#include "core/io/report_html.h"

namespace odolab {

// Every run is in it, those that were left out too, and how each number was found.
HtmlReport guide_report(const GuideSession& session, const GuideOutcome& outcome);

}  // namespace odolab
