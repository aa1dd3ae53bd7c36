#include "core/io/import/bag_choice.h"

#include <algorithm>
#include <array>

#include "core/io/number_text.h"

namespace odolab {

namespace {

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool holds(const std::string& text, std::string_view word) { return text.find(word) != std::string::npos; }

// The words of a name: "/vrpn_client/Robot1" has vrpn, client, robot.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  char before = 0;
  for (char c : name) {
    const bool upper = c >= 'A' && c <= 'Z';
    const bool letter = upper || (c >= 'a' && c <= 'z');
    if (!letter || (upper && before >= 'a' && before <= 'z')) words.emplace_back();
    if (letter) words.back() += lower(std::string(1, c));
    before = c;
  }
  words.erase(std::remove(words.begin(), words.end(), std::string()), words.end());
  return words;
}

bool has_word(const std::string& name, std::initializer_list<std::string_view> wanted) {
  const std::vector<std::string> words = words_of(name);
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(wanted.begin(), wanted.end(), word) != wanted.end();
  });
}

enum class Side { none, left, right };

Side side_of(const std::string& joint) {
  const bool left = holds(lower(joint), "left") || has_word(joint, {"l", "lt", "lhs"});
  const bool right = holds(lower(joint), "right") || has_word(joint, {"r", "rt", "rhs"});
  return left == right ? Side::none : left ? Side::left : Side::right;
}

bool is_drive_wheel(const std::string& joint) {
  const std::string name = lower(joint);
  for (const char* other : {"caster", "castor", "steer", "pivot", "suspension", "gripper", "finger"})
    if (holds(name, other)) return false;
  return holds(name, "wheel") || holds(name, "whl") || holds(name, "drive");
}

bool says_truth(const std::string& name) {
  const std::string text = lower(name);
  for (const char* word : {"truth", "mocap", "motion_capture", "vicon", "optitrack", "qualisys", "vrpn", "natnet",
                           "phasespace", "rigid_bod", "lighthouse", "total_station"})
    if (holds(text, word)) return true;
  return has_word(name, {"gt"});
}

// Poses that somebody estimated or wished for.
bool says_no_truth(const std::string& name) {
  const std::string text = lower(name);
  for (const char* word : {"odom", "amcl", "goal", "initial", "slam", "ekf", "ukf", "filtered", "estimat", "target",
                           "setpoint", "desired", "plan", "waypoint", "cmd"})
    if (holds(text, word)) return true;
  return false;
}

std::string listed_topics(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kMost; ++i) text += (i ? ", " : "") + names[i];
  return names.size() > kMost ? text + ", …" : text;
}

struct TruthCandidate {
  std::string topic, parent, child;
  bool transform = false;

  std::string name() const { return transform ? topic + ":" + parent + ":" + child : topic; }
};

std::vector<TruthCandidate> truth_candidates(const BagContents& contents) {
  std::vector<TruthCandidate> candidates;
  for (const BagTopicContents& topic : contents.topics) {
    if (topic.messages == 0) continue;
    if (topic.kind == RosKind::pose) candidates.push_back({topic.topic.name, "", "", false});
    if (topic.kind == RosKind::transforms)
      for (const BagTransform& t : topic.transforms) candidates.push_back({topic.topic.name, t.parent, t.child, true});
  }
  return candidates;
}

std::vector<std::string> names_of(const std::vector<TruthCandidate>& candidates) {
  std::vector<std::string> names;
  for (const TruthCandidate& c : candidates) names.push_back(c.name());
  return names;
}

std::optional<Error> choose_truth(const std::string& path, const BagContents& contents, const std::string& wish,
                                  BagChoice& choice) {
  if (wish == "none") return std::nullopt;
  const std::vector<TruthCandidate> all = truth_candidates(contents);
  const auto take = [&](const TruthCandidate& c) {
    choice.truth = c.name();
    if (c.transform) choice.truth_chain = chain_of_transforms(contents, c.topic, c.parent, c.child);
  };
  if (!wish.empty()) {
    std::vector<TruthCandidate> meant;
    for (const TruthCandidate& c : all)
      if (c.name() == wish || c.topic == wish) meant.push_back(c);
    if (meant.size() == 1) {
      take(meant.front());
      return std::nullopt;
    }
    // a pair of frames that are joined by way of others
    const std::size_t second = wish.rfind(':'),
                      first = second == std::string::npos ? second : wish.rfind(':', second - 1);
    if (meant.empty() && first != std::string::npos && first > 0) {
      const std::string from = wish.substr(first + 1, second - first - 1), to = wish.substr(second + 1);
      choice.truth_chain = chain_of_transforms(contents, wish.substr(0, first), from, to);
      if (!choice.truth_chain.empty()) {
        choice.truth = wish;
        return std::nullopt;
      }
      if (!all.empty())
        return Error{path,
                     "no chain of transforms from " + in_quotes(from) + " to " + in_quotes(to) + " on " +
                         in_quotes(wish.substr(0, first)),
                     "--truth with frames that are joined by " + listed_topics(names_of(all))};
    }
    if (meant.empty())
      return Error{path, "no poses on " + in_quotes(wish),
                   all.empty() ? "a bag with poses" : "--truth with one of " + listed_topics(names_of(all))};
    return Error{path, "several transforms on " + in_quotes(wish),
                 "--truth with one of " + listed_topics(names_of(meant))};
  }
  std::vector<TruthCandidate> said, said_poses, others;
  for (const TruthCandidate& c : all) {
    if (says_truth(c.name())) {
      said.push_back(c);
      if (!c.transform) said_poses.push_back(c);
    } else if (!c.transform && !says_no_truth(c.name())) {
      others.push_back(c);
    }
  }
  if (said.size() > 1 && said_poses.size() == 1) said = said_poses;  // the same, sent as a transform besides
  if (said.size() == 1) {
    take(said.front());
  } else if (said.empty() && others.size() == 1) {
    take(others.front());
    choice.warnings.push_back("taken as the outside truth: " + others.front().name() + "; --truth says otherwise");
  } else if (said.empty() && others.empty()) {
    if (!all.empty())
      choice.warnings.push_back("no outside truth was found; --truth can name one of " + listed_topics(names_of(all)));
  } else {
    return Error{path, "several that may be the outside truth",
                 "--truth with one of " + listed_topics(names_of(said.empty() ? others : said)) + ", or none"};
  }
  return std::nullopt;
}

std::optional<Error> choose_wheels(const std::string& path, const BagContents& contents, const ImportWishes& wishes,
                                   BagChoice& choice) {
  std::vector<const BagTopicContents*> topics;
  std::vector<std::string> names;
  for (const BagTopicContents& topic : contents.topics) {
    if (topic.kind != RosKind::joint_state || topic.messages == 0) continue;
    names.push_back(topic.topic.name);
    if (wishes.wheels.empty() || topic.topic.name == wishes.wheels) topics.push_back(&topic);
  }
  if (topics.empty()) {
    if (!wishes.wheels.empty())
      return Error{path, "no joint states on " + in_quotes(wishes.wheels),
                   names.empty() ? "a bag with joint states" : "--wheels with one of " + listed_topics(names)};
    if (!wishes.left_joint.empty()) return Error{path, "no joint states", "a bag with the joints that were named"};
    return std::nullopt;
  }
  struct Match {
    const BagTopicContents* topic;
    std::string left, right;
  };
  std::vector<Match> matches;
  const auto has = [](const BagTopicContents& topic, const std::string& joint) {
    return std::find(topic.joints.begin(), topic.joints.end(), joint) != topic.joints.end();
  };
  for (const BagTopicContents* topic : topics) {
    if (!wishes.left_joint.empty()) {
      if (has(*topic, wishes.left_joint) && has(*topic, wishes.right_joint))
        matches.push_back({topic, wishes.left_joint, wishes.right_joint});
    } else if (const auto [left, right] = wheel_joints(topic->joints); !left.empty()) {
      matches.push_back({topic, left, right});
    }
  }
  if (matches.size() > 1) {
    std::vector<std::string> on;
    for (const Match& match : matches) on.push_back(match.topic->topic.name);
    return Error{path, "drive wheels on several topics", "--wheels with one of " + listed_topics(on)};
  }
  if (matches.empty()) {
    const BagTopicContents& first = *topics.front();
    if (!wishes.left_joint.empty())
      for (const std::string& joint : {wishes.left_joint, wishes.right_joint})
        if (!has(first, joint))
          return Error{path, "no joint " + in_quotes(joint), "--joints LEFT,RIGHT of " + listed_topics(first.joints)};
    return Error{path, "joints of which two are not plainly the drive wheels",
                 "--joints LEFT,RIGHT of " + listed_topics(first.joints)};
  }
  choice.wheels = matches.front().topic->topic.name;
  choice.left_joint = matches.front().left;
  choice.right_joint = matches.front().right;
  return std::nullopt;
}

std::optional<Error> choose_commands(const std::string& path, const BagContents& contents, const std::string& wish,
                                     BagChoice& choice) {
  if (wish == "none") return std::nullopt;
  std::vector<std::string> all, plain;
  for (const BagTopicContents& topic : contents.topics) {
    if (topic.kind != RosKind::twist || topic.messages == 0) continue;
    const std::string& name = topic.topic.name;
    all.push_back(name);
    if (name.substr(name.rfind('/') + 1) == "cmd_vel") plain.push_back(name);
  }
  if (!wish.empty()) {
    if (std::find(all.begin(), all.end(), wish) == all.end())
      return Error{path, "no twists on " + in_quotes(wish),
                   all.empty() ? "a bag with twists" : "--commands with one of " + listed_topics(all)};
    choice.commands = wish;
  } else if (all.size() == 1) {
    choice.commands = all.front();
  } else if (plain.size() == 1) {
    choice.commands = plain.front();
    choice.warnings.push_back("taken as the commands: " + plain.front() + ", of " + listed_topics(all));
  } else if (all.size() > 1) {
    if (choice.wheels.empty())
      return Error{path, "several topics of twists", "--commands with one of " + listed_topics(all)};
    choice.warnings.push_back("commands are left out; --commands can name one of " + listed_topics(all));
  }
  return std::nullopt;
}

}  // namespace

std::pair<std::string, std::string> wheel_joints(const std::vector<std::string>& joints) {
  // first those whose names say wheel; else two joints, one on each side, are the wheels
  for (bool wheels_alone : {true, false}) {
    if (!wheels_alone && joints.size() != 2) break;
    std::vector<std::string> left, right;
    for (const std::string& joint : joints) {
      if (wheels_alone && !is_drive_wheel(joint)) continue;
      if (side_of(joint) == Side::left) left.push_back(joint);
      if (side_of(joint) == Side::right) right.push_back(joint);
    }
    if (left.size() == 1 && right.size() == 1) return {left.front(), right.front()};
  }
  return {};
}

Result<BagChoice> chosen_of_bag(const std::string& path, const BagContents& contents, const ImportWishes& wishes) {
  BagChoice choice;
  if (const auto error = choose_wheels(path, contents, wishes, choice)) return *error;
  if (const auto error = choose_commands(path, contents, wishes.commands, choice)) return *error;
  if (const auto error = choose_truth(path, contents, wishes.truth, choice)) return *error;
  if (choice.wheels.empty() && choice.commands.empty() && choice.truth.empty()) {
    std::vector<std::string> types;
    for (const BagTopicContents& topic : contents.topics)
      types.push_back(topic.topic.name + " (" + (topic.topic.type.empty() ? "no type" : topic.topic.type) + ")");
    return Error{path, types.empty() ? "a bag without topics" : "a bag with " + listed_topics(types),
                 "joint states, twists, odometry, poses or transforms with messages, in CDR"};
  }
  if (choice.wheels.empty() && choice.commands.empty())
    choice.warnings.push_back("neither wheels nor commands were found: the recording holds the truth alone");
  return choice;
}

}  // namespace odolab
