// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "picture_thread.h"

#include <unistd.h>

#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>

namespace hooke::python {
namespace {

// Never ends: the driver's state is not taken down while the interpreter exits.
class PictureThread {
 public:
  PictureThread() {
    std::thread([this] { work(); }).detach();
  }

  bool run(const std::function<void()>& task) {
    if (getpid() != process_) return false;
    std::packaged_task<void()> packaged(task);
    auto done = packaged.get_future();
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(packaged));
    }
    changed_.notify_one();
    done.get();
    return true;
  }

 private:
  void work() {
    while (true) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !tasks_.empty(); });
      std::packaged_task<void()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
    }
  }

  const pid_t process_ = getpid();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::packaged_task<void()>> tasks_;
};

}  // namespace

bool on_picture_thread(const std::function<void()>& task) {
  static PictureThread& thread = *new PictureThread;
  return thread.run(task);
}

void PictureMaker::close() {
  if (studio_ && !on_picture_thread([this] { studio_.reset(); })) (void)studio_.release();  // the driver is not here
}

Expected<render::Image> PictureMaker::picture(const run::PictureArguments& arguments, const Scene& scene,
                                              const ParticleSet& first, const std::vector<ParticleSet>* moments,
                                              const ParticleSet& now, double time) {
  Expected<render::Image> image;
  const bool drawn = on_picture_thread([&] {
    if (!studio_ || !(arguments == arguments_)) {
      studio_.reset();
      auto opened = run::Studio::open(arguments);
      if (!opened) {
        image = fail(std::move(opened).error());
        return;
      }
      studio_ = std::make_unique<run::Studio>(std::move(*opened));
      arguments_ = arguments;
      studio_->set_scene(scene, first);
      if (moments != nullptr) studio_->frame_action(*moments);
    }
    image = studio_->picture(now, time);
  });
  if (!drawn)
    return fail(Error::Kind::bad_input, "process", "was forked from one that has drawn pictures, and can draw none");
  return image;
}

}  // namespace hooke::python
