#include "crt/job.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "core/render/rendering.hpp"
#include "core/tasks/tasks.hpp"
#include "crt/error.hpp"

namespace crt {

class RenderJob::State {
 public:
  State(const PreparedScene& scene, RenderOptions options)
      : scene_(scene), rendering_(scene_.data(), adapted(std::move(options))) {}

  /// Starts the thread, which keeps `self` until its end.
  void start(const std::shared_ptr<State>& self) {
    try {
      thread_ = std::thread([self] { self->work(); });
    } catch (const std::system_error&) {
      throw Error(ErrorCode::limit, "the system gives no further thread to render on");
    }
  }

  /// Stops the job. Its thread has ended after this unless it is the one that calls.
  void end() {
    rendering_.cancel();
    if (inside() == this) {
      thread_.detach();
    } else {
      thread_.join();
    }
  }

  Image wait() {
    if (inside() == this) {
      throw Error(ErrorCode::invalid_argument,
                  "a job cannot wait for itself: not in its own callbacks");
    }
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [this] { return finished_; });
    if (failure_) std::rethrow_exception(failure_);
    return rendering_.picture();
  }

  bool finished() const {
    const std::lock_guard lock(mutex_);
    return finished_;
  }

  core::Rendering& rendering() { return rendering_; }

 private:
  /// Returns the job whose callback this thread is in.
  static const State*& inside() {
    static thread_local const State* job = nullptr;
    return job;
  }

  class InCallback {
   public:
    explicit InCallback(const State* job) : before_(std::exchange(inside(), job)) {}
    ~InCallback() { inside() = before_; }
    InCallback(const InCallback&) = delete;
    InCallback& operator=(const InCallback&) = delete;

   private:
    const State* before_;
  };

  /// Returns the options with callbacks that know whose they are. If they do not say how many
  /// threads, they get as many as the arena of the calling thread has. In that arena itself the
  /// place of the calling thread would stay empty.
  RenderOptions adapted(RenderOptions options) {
    options.threads = core::allowed_threads(options.threads);
    if (options.progress) {
      options.progress = [this, progress = std::move(options.progress)](double share) {
        const InCallback mark(this);
        return progress(share);
      };
    }
    if (options.log) {
      options.log = [this, log = std::move(options.log)](LogLevel level, std::string_view line) {
        const InCallback mark(this);
        log(level, line);
      };
    }
    return options;
  }

  void work() noexcept {
    std::exception_ptr failure;
    try {
      rendering_.run();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    failure_ = failure;
    finished_ = true;
    ended_.notify_all();
  }

  PreparedScene scene_;
  core::Rendering rendering_;
  std::thread thread_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  bool finished_ = false;
  std::exception_ptr failure_;
};

RenderJob::RenderJob(const PreparedScene& scene, RenderOptions options) {
  try {
    state_ = std::make_shared<State>(scene, std::move(options));
    state_->start(state_);
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory to start a render");
  }
}

RenderJob::~RenderJob() {
  if (state_) state_->end();
}

RenderJob::RenderJob(RenderJob&&) noexcept = default;

RenderJob& RenderJob::operator=(RenderJob&& other) noexcept {
  RenderJob taken(std::move(other));
  std::swap(state_, taken.state_);
  return *this;
}

double RenderJob::progress() const {
  return state_->rendering().share_done();
}

Image RenderJob::snapshot() const {
  return state_->rendering().picture();
}

Image RenderJob::denoised(const std::function<bool()>& go_on) const {
  return state_->rendering().denoised(go_on);
}

void RenderJob::cancel() {
  state_->rendering().cancel();
}

bool RenderJob::finished() const {
  return state_->finished();
}

Image RenderJob::wait() const {
  return state_->wait();
}

}  // namespace crt
