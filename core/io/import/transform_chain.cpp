#include "core/io/import/transform_chain.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace odolab {

namespace {

constexpr std::int64_t kLongestGap_ns = 10'000'000'000;

double norm_of(const RosPose& p) { return std::sqrt(p.qx * p.qx + p.qy * p.qy + p.qz * p.qz + p.qw * p.qw); }

// v turned by the pose's rotation, which has length 1.
void turn(const RosPose& p, double& x, double& y, double& z) {
  // v + 2 q x (q x v + w v)
  const double a = p.qy * z - p.qz * y + p.qw * x, b = p.qz * x - p.qx * z + p.qw * y,
               c = p.qx * y - p.qy * x + p.qw * z;
  x += 2.0 * (p.qy * c - p.qz * b);
  y += 2.0 * (p.qz * a - p.qx * c);
  z += 2.0 * (p.qx * b - p.qy * a);
}

RosPose product(const RosPose& p, const RosPose& q) {
  RosPose r;
  r.x = q.x, r.y = q.y, r.z = q.z;
  turn(p, r.x, r.y, r.z);
  r.x += p.x, r.y += p.y, r.z += p.z;
  r.qw = p.qw * q.qw - p.qx * q.qx - p.qy * q.qy - p.qz * q.qz;
  r.qx = p.qw * q.qx + p.qx * q.qw + p.qy * q.qz - p.qz * q.qy;
  r.qy = p.qw * q.qy - p.qx * q.qz + p.qy * q.qw + p.qz * q.qx;
  r.qz = p.qw * q.qz + p.qx * q.qy - p.qy * q.qx + p.qz * q.qw;
  return r;
}

RosPose inverse(const RosPose& p) {
  RosPose r;
  r.qx = -p.qx, r.qy = -p.qy, r.qz = -p.qz, r.qw = p.qw;
  r.x = -p.x, r.y = -p.y, r.z = -p.z;
  turn(r, r.x, r.y, r.z);
  return r;
}

RosPose between(const RosPose& a, const RosPose& b, double share) {
  RosPose r;
  r.x = a.x + share * (b.x - a.x);
  r.y = a.y + share * (b.y - a.y);
  r.z = a.z + share * (b.z - a.z);
  const double cosine = a.qx * b.qx + a.qy * b.qy + a.qz * b.qz + a.qw * b.qw;
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  const double angle_rad = std::acos(std::min(1.0, std::abs(cosine)));
  const bool small = angle_rad < 1e-6;
  const double u = small ? 1.0 - share : std::sin((1.0 - share) * angle_rad) / std::sin(angle_rad);
  const double v = sign * (small ? share : std::sin(share * angle_rad) / std::sin(angle_rad));
  r.qx = u * a.qx + v * b.qx;
  r.qy = u * a.qy + v * b.qy;
  r.qz = u * a.qz + v * b.qz;
  r.qw = u * a.qw + v * b.qw;
  return r;
}

bool is_static(const std::string& topic) {
  return topic.size() > 7 && topic.compare(topic.size() - 7, 7, "_static") == 0;
}

}  // namespace

std::vector<TransformHop> chain_of_transforms(const BagContents& contents, const std::string& topic,
                                              const std::string& from, const std::string& to) {
  std::vector<TransformHop> edges;
  for (const BagTopicContents& source : contents.topics) {
    if (source.kind != RosKind::transforms || (source.topic.name != topic && source.topic.name != topic + "_static"))
      continue;
    for (const BagTransform& t : source.transforms)
      edges.push_back({source.topic.name, t.parent, t.child, false, is_static(source.topic.name) || t.messages == 1,
                       t.messages, t.last});
  }
  // breadth first: by which edge each frame was reached
  std::map<std::string, TransformHop> reached_by;
  std::vector<std::string> frames{from};
  for (std::size_t i = 0; i < frames.size() && reached_by.count(to) == 0; ++i)
    for (TransformHop edge : edges) {
      edge.upward = edge.child == frames[i];
      if (!edge.upward && edge.parent != frames[i]) continue;
      const std::string& next = edge.upward ? edge.parent : edge.child;
      if (next == from || reached_by.count(next)) continue;
      reached_by[next] = edge;
      frames.push_back(next);
    }
  std::vector<TransformHop> chain;
  for (std::string frame = to; frame != from;) {
    const auto edge = reached_by.find(frame);
    if (edge == reached_by.end()) return {};
    chain.push_back(edge->second);
    frame = edge->second.upward ? edge->second.child : edge->second.parent;
  }
  std::reverse(chain.begin(), chain.end());
  return chain;
}

TransformChain::TransformChain(std::vector<TransformHop> hops) {
  for (TransformHop& hop : hops) hops_.push_back({std::move(hop), {}});
  const auto rank = [](const Hop& hop) { return hop.of.fixed ? 0 : hop.of.messages; };
  for (std::size_t i = 1; i < hops_.size(); ++i)
    if (rank(hops_[i]) > rank(hops_[leader_])) leader_ = i;
}

bool TransformChain::wants(const std::string& topic, const RosPose& pose) const {
  for (std::size_t i = 0; i < hops_.size(); ++i)
    if (hops_[i].of.topic == topic && hops_[i].of.parent == pose.frame && hops_[i].of.child == pose.child_frame)
      return i == leader_ || !hops_[i].of.fixed;
  return false;
}

bool TransformChain::value_at(const Hop& hop, std::int64_t stamp_ns, RosPose& value) const {
  if (hop.of.fixed) {
    value = hop.of.value;
    return true;
  }
  const auto after = std::lower_bound(hop.sent.begin(), hop.sent.end(), stamp_ns,
                                      [](const RosPose& p, std::int64_t ns) { return p.stamp_ns < ns; });
  if (after == hop.sent.end()) return false;
  if (after->stamp_ns == stamp_ns) {
    value = *after;
    return true;
  }
  if (after == hop.sent.begin()) return false;
  const RosPose& before = *std::prev(after);
  const double gap_ns = static_cast<double>(after->stamp_ns) - static_cast<double>(before.stamp_ns);
  if (gap_ns > static_cast<double>(kLongestGap_ns)) return false;
  value = between(before, *after, (static_cast<double>(stamp_ns) - static_cast<double>(before.stamp_ns)) / gap_ns);
  return true;
}

void TransformChain::add(const std::string& topic, const RosPose& pose, const Sink& sink) {
  RosPose unit = pose;
  const double norm = norm_of(pose);
  if (!(norm > 1e-6) || !std::isfinite(norm)) return;
  unit.qx /= norm, unit.qy /= norm, unit.qz /= norm, unit.qw /= norm;
  for (std::size_t i = 0; i < hops_.size(); ++i) {
    Hop& hop = hops_[i];
    if (hop.of.topic != topic || hop.of.parent != pose.frame || hop.of.child != pose.child_frame) continue;
    if (i == leader_) {
      waiting_.push_back(unit);
    } else if (!hop.of.fixed) {
      const auto after = std::upper_bound(hop.sent.begin(), hop.sent.end(), unit.stamp_ns,
                                          [](std::int64_t ns, const RosPose& p) { return ns < p.stamp_ns; });
      hop.sent.insert(after, unit);
    }
  }
  give(sink);
}

void TransformChain::give(const Sink& sink) {
  while (!waiting_.empty()) {
    const RosPose led = waiting_.front();
    RosPose whole;
    bool known = true;
    for (std::size_t i = 0; i < hops_.size(); ++i) {
      RosPose value = led;
      if (i != leader_ && !value_at(hops_[i], led.stamp_ns, value)) {
        const Hop& hop = hops_[i];
        const bool may_come = hop.sent.empty() || hop.sent.back().stamp_ns < led.stamp_ns;
        const double behind_ns = static_cast<double>(waiting_.back().stamp_ns) - static_cast<double>(led.stamp_ns);
        if (may_come && behind_ns <= static_cast<double>(kLongestGap_ns)) return;
        known = false;
        break;
      }
      if (hops_[i].of.upward) value = inverse(value);
      whole = product(whole, value);
    }
    waiting_.pop_front();
    if (!known) {
      ++left_out_;
      continue;
    }
    // what lies before the last one at or below this stamp is done with, but for messages that come late
    for (Hop& hop : hops_)
      while (hop.sent.size() > 2 && hop.sent[1].stamp_ns < led.stamp_ns - kLongestGap_ns / 10) hop.sent.pop_front();
    whole.stamp_ns = led.stamp_ns;
    sink(whole);
  }
}

}  // namespace odolab
