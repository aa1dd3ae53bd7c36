// What a panel asked for while a test used it.
#pragma once

#include "ui/actions.h"

namespace odolab::ui {

template <typename A>
int count_of(const Actions& asked) {
  int n = 0;
  for (const Action& a : asked) n += std::holds_alternative<A>(a);
  return n;
}

}  // namespace odolab::ui
