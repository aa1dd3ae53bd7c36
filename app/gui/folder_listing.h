// What can be opened in the folder that a person is typing.
#pragma once

#include <string>
#include <vector>

#include "ui/panels/path_dialog.h"

namespace odolab {

class FolderListing {
 public:
  // Folders, then files that can be opened, of the folder of this unfinished path; their names begin as its last part
  // does, or are all there are where that is the name of one. The folder is read once, until another one is asked for.
  const std::vector<ui::PathEntry>& of(const std::string& typed);
  void forget() { known_ = false; }

 private:
  bool known_ = false;
  std::string folder_, typed_;
  std::vector<ui::PathEntry> all_, matching_;
};

// With the home folder in the place of a "~" at its beginning.
std::string expanded(const std::string& path);

}  // namespace odolab
