// The page of the guide in the middle: what to do, and where it is entered.
#pragma once

#include "ui/actions.h"
#include "ui/guide.h"
#include "ui/look/theme.h"
#include "ui/panels/cluster_panel.h"

namespace odolab::ui {

struct GuidePageState {
  GuideSession draft;  // what is being edited; anything else shows the session as it is
  bool editing = false;
  ClusterState clusters;
  std::string export_folder;   // where files are proposed
  float covered_below = 0.0f;  // px of the page, by a message
  bool ask_for_file = false;   // a vehicle shall be opened; the caller takes it
};

Actions guide_page(const GuideView& view, GuidePageState& state, const Theme& theme);

}  // namespace odolab::ui
