#include "core/base/parallel.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace odolab {

namespace {

int cores() {
  static const int count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return count;
}

// Threads that stay, one fewer than there are cores, since to start them anew takes longer than many a piece of work.
// Whoever asks works too, and while it waits for the last piece helps whatever was asked for within that.
class Helpers {
 public:
  Helpers() {
    for (int t = 1; t < cores(); ++t)
      std::thread([this] {
        std::unique_lock<std::mutex> lock(mutex_);
        while (true) help_or_wait(lock);
      }).detach();
  }

  void work_through(int count, const std::function<void(int)>& work) {
    Job job{count, work};
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      open_.push_back(&job);
    }
    changed_.notify_all();
    job.go_on();
    std::unique_lock<std::mutex> lock(mutex_);
    std::erase(open_, &job);
    while (job.helpers > 0) help_or_wait(lock);
  }

 private:
  struct Job {
    int count;
    const std::function<void(int)>& work;
    std::atomic<int> next{0};
    int helpers = 0;

    void go_on() {
      for (int i = next++; i < count; i = next++) work(i);
    }
  };

  void help_or_wait(std::unique_lock<std::mutex>& lock) {
    if (open_.empty()) {
      changed_.wait(lock);
      return;
    }
    Job& job = *open_.back();
    ++job.helpers;
    lock.unlock();
    job.go_on();
    lock.lock();
    std::erase(open_, &job);
    if (--job.helpers == 0) changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Job*> open_;  // the innermost last
};

}  // namespace

int parallel_for(int count, const std::function<void(int, const std::atomic<bool>&)>& work,
                 const std::function<void(int)>& done, const Progress& progress) {
  if (count <= 0) return 0;
  if (!done && !progress) {  // nobody waits for a part
    // Never destroyed: a process may end while they are at work.
    static Helpers& helpers = *new Helpers;
    const std::atomic<bool> never{false};
    helpers.work_through(count, [&](int i) { work(i, never); });
    return count;
  }
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<char> finished(static_cast<std::size_t>(count), 0);
  std::atomic<int> next{0};
  std::atomic<bool> stopped{false};
  const auto worker = [&] {
    for (int i = next++; i < count && !stopped; i = next++) {
      work(i, stopped);
      if (stopped) return;
      const std::lock_guard<std::mutex> lock(mutex);
      finished[static_cast<std::size_t>(i)] = 1;
      changed.notify_one();
    }
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < std::min(cores(), count); ++t) threads.emplace_back(worker);
  int in_order = 0;
  while (in_order < count && !stopped) {
    {
      std::unique_lock<std::mutex> lock(mutex);
      const bool ready = changed.wait_for(lock, std::chrono::milliseconds(100),
                                          [&] { return finished[static_cast<std::size_t>(in_order)] != 0; });
      if (!ready) {
        lock.unlock();
        if (!goes_on(progress, static_cast<double>(in_order) / count)) stopped = true;
        continue;
      }
    }
    if (done) done(in_order);
    ++in_order;
    if (!goes_on(progress, static_cast<double>(in_order) / count)) stopped = true;
  }
  for (std::thread& thread : threads) thread.join();
  return in_order;
}

int parallel_for(int count, const std::function<void(int)>& work, const std::function<void(int)>& done,
                 const Progress& progress) {
  return parallel_for(
      count, [&work](int i, const std::atomic<bool>&) { work(i); }, done, progress);
}

}  // namespace odolab
