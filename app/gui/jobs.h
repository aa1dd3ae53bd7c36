// Work that takes longer than a picture: one job at a time beside the window, with progress and cancel.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/progress.h"

namespace odolab {

class Jobs {
 public:
  // Something to be done by the window's thread, e.g. to take in a result.
  using Delivery = std::function<void()>;
  using Deliver = std::function<void(Delivery)>;
  // What runs aside. It stops where `progress` returns false.
  using Work = std::function<void(const Progress& progress, const Deliver& deliver)>;

  // Without a thread a job runs to its end inside start(): for pictures that must always be the same.
  explicit Jobs(bool threaded) : threaded_(threaded) {}
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // Does nothing and returns false while another job runs. `finished` is delivered last, cancelled or not.
  bool start(std::string name, Work work, std::function<void(bool cancelled)> finished = {});
  // Asks the job to stop; its deliveries so far still come.
  void cancel();
  // Takes in what the job has delivered. Called by the window's thread, once for each picture.
  void poll();

  bool running() const { return running_; }
  const std::string& name() const { return name_; }
  double share_done() const { return share_done_; }

 private:
  void deliver(Delivery delivery);

  bool threaded_;
  bool running_ = false;
  std::string name_;
  std::thread thread_;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> share_done_{0.0};
  std::mutex mutex_;
  std::vector<Delivery> delivered_;
};

}  // namespace odolab
