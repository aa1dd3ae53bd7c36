// A pose that ROS keeps as a chain of transforms (map to odom, odom to base_link), put together.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "core/io/bag/bag.h"

namespace odolab {

// One step from a frame to the next.
struct TransformHop {
  std::string topic, parent, child;  // as the message has them
  bool upward = false;               // the chain goes from the child to the parent
  bool fixed = false;                // on /tf_static, or sent once
  std::uint64_t messages = 0;
  RosPose value;  // where it is fixed
};

// The shortest chain from one frame to another through the transforms on `topic` and on its namesake ending in
// "_static"; empty where there is none.
std::vector<TransformHop> chain_of_transforms(const BagContents& contents, const std::string& topic,
                                              const std::string& from, const std::string& to);

// Multiplies the hops of a chain, as their messages come, at the stamps of the hop that is sent most often; the others
// are interpolated between their stamps (linearly, rotations along the shortest arc), never extrapolated.
class TransformChain {
 public:
  using Sink = std::function<void(const RosPose& pose)>;  // stamped; the frames are those of the chain's ends

  // `hops`: at least one.
  explicit TransformChain(std::vector<TransformHop> hops);

  // Whether a transform moves one of the hops.
  bool wants(const std::string& topic, const RosPose& pose) const;
  // Takes one of them.
  void add(const std::string& topic, const RosPose& pose, const Sink& sink);
  // After the last one. Poses for which another hop was not sent within ten seconds before and after, as tf2 keeps
  // them, are left out.
  std::uint64_t left_out() const { return left_out_ + waiting_.size(); }

 private:
  struct Hop {
    TransformHop of;
    std::deque<RosPose> sent;  // in order of their stamps, from the last one that may still be needed
  };
  bool value_at(const Hop& hop, std::int64_t stamp_ns, RosPose& value) const;
  void give(const Sink& sink);

  std::vector<Hop> hops_;
  std::size_t leader_ = 0;
  std::deque<RosPose> waiting_;  // of the leader, until the others have come
  std::uint64_t left_out_ = 0;
};

}  // namespace odolab
