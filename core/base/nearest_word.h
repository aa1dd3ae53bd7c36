// Which of the known words somebody who wrote another may have meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace odolab {

// Letters to insert, leave out or exchange to get from one to the other (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

// The known word that is most like another: a third of its letters may differ, or two. Null where none is near.
const std::string* nearest_word(std::string_view word, const std::vector<std::string>& known);

}  // namespace odolab
