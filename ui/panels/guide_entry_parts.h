// What the pages of a guide share: where an entry goes, the button that lets the simulation drive, the clusters.
#pragma once

#include "ui/look/widgets.h"
#include "ui/panels/guide_page.h"

namespace odolab::ui {

// What a ruler on the floor reads.
inline const Unit kReadMillimetres{"mm", 1e3, 1, 0.2};

// Hands the draft over where something was edited: half-typed numbers, too, nothing is lost.
void keep(Edited edited, GuidePageState& state, Actions& actions);

// The button that lets the simulation do a page, with its progress.
Actions drive_button(const GuideView& view, const char* words, const Theme& theme);

// The rounds so far in the rest of the page.
void clusters(const GuideView& view, bool last_alone, GuidePageState& state, const Theme& theme);

// The pages, by what they ask for.
Actions robot_page(const GuideView& view, GuidePageState& state, const Theme& theme);
Actions tape_page(const GuideView& view, GuidePageState& state, const Theme& theme);
Actions drive_page(const GuideView& view, GuidePageState& state, const Theme& theme);
Actions runs_page(const GuideView& view, PageTask task, GuidePageState& state, const Theme& theme);
Actions recordings_page(const GuideView& view, const Theme& theme);
Actions held_out_page(const GuideView& view, const Theme& theme);
void result_page(const GuideView& view, GuidePageState& state, const Theme& theme);
Actions verdict_page(const GuideView& view, GuidePageState& state, const Theme& theme);
Actions finish_page(const GuideView& view, GuidePageState& state, const Theme& theme);

}  // namespace odolab::ui
