// The [actual] table of a scenario: how the machine itself differs from its drawing.
#pragma once

#include "core/scenario/scenario.h"

namespace odolab {

class TomlTable;
class TomlText;

// The nominal vehicle must be there already: its kind decides which keys may stand here, and what is absent is as it
// says.
void read_actual(TomlTable table, Scenario& scenario, bool as_drawn_at_first);
void write_actual(TomlText& text, const Scenario& scenario);

}  // namespace odolab
