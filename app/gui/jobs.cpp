#include "app/gui/jobs.h"

namespace odolab {

Jobs::~Jobs() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

bool Jobs::start(std::string name, Work work, std::function<void(bool)> finished) {
  if (running_) return false;
  if (thread_.joinable()) thread_.join();
  name_ = std::move(name);
  running_ = true;
  cancelled_ = false;
  share_done_ = 0.0;
  const auto all = [this, work = std::move(work), finished = std::move(finished)] {
    const Progress progress = [this](double share) {
      share_done_ = share;
      return !cancelled_;
    };
    work(progress, [this](Delivery d) { deliver(std::move(d)); });
    deliver([this, finished] {
      running_ = false;
      if (finished) finished(cancelled_);
    });
  };
  if (threaded_)
    thread_ = std::thread(all);
  else
    all();
  return true;
}

void Jobs::cancel() { cancelled_ = true; }

void Jobs::deliver(Delivery delivery) {
  const std::lock_guard<std::mutex> lock(mutex_);
  delivered_.push_back(std::move(delivery));
}

void Jobs::poll() {
  std::vector<Delivery> now;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    now.swap(delivered_);
  }
  for (const Delivery& d : now) d();
}

}  // namespace odolab
