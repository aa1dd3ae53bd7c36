// A guide's session as a TOML file: all that a person has entered, and where they stand.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/guide/guide_session.h"

namespace odolab {

// Errors name file and line or key; a session that comes back has no problems.
Result<GuideSession> read_guide_session(const std::string& path);

// Whole or not at all, and on the disk when it returns: a kill at any moment leaves the last session written.
Result<Done> write_guide_session(const std::string& path, const GuideSession& session);

}  // namespace odolab
