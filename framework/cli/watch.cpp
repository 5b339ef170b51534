#include "framework/cli/watch.hpp"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <memory>
#include <ostream>
#include <sstream>
#include <thread>

#include "framework/base/file_watch.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/base/text.hpp"
#include "framework/cli/messages.hpp"

namespace lightloom::cli {
namespace {

using Clock = std::chrono::steady_clock;
using Paths = std::vector<std::filesystem::path>;

constexpr std::chrono::milliseconds kLookEvery{100};

/// Some file changed while frames were rendered.
struct Outdated {
  Paths changed;
};

std::string names_of(const Paths& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) {
    std::string name = file.filename().string();
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  return join(names, ", ");
}

class Watch {
 public:
  Watch(const run::RenderRequest& request, const CommandContext& context,
        const std::function<void(const run::RenderSummary&)>& report)
      : request_(request), context_(context), report_(report), renderer_(make_renderer()) {}

  [[noreturn]] void run() {
    Paths changed;
    while (true) {
      changed = render(changed);
      if (changed.empty()) changed = wait_for_change();
      renderer_->forget(changed);
    }
  }

 private:
  [[nodiscard]] std::unique_ptr<run::Renderer> make_renderer() const {
    return std::make_unique<run::Renderer>(context_.registry);
  }

  /// Renders once, because of these files. Returns those that changed meanwhile, if that put an end to it.
  Paths render(const Paths& because) {
    const Clock::time_point start = Clock::now();
    Diagnostics diagnostics;
    run::RenderSummary summary;
    try {
      const bool rendered = renderer_->render(request_, events(because, start), diagnostics, summary);
      print_diagnostics(context_.err, diagnostics);
      for (const std::string& warning : summary.warnings) print_warning(context_.err, warning);
      if (rendered) {
        report_(summary);
        context_.out.flush();
        for (const std::string& failure : summary.failures) print_error(context_.err, failure, "");
        stop_if_interrupted();
      }
      say_that_it_waits(rendered);
    } catch (const Outdated& outdated) {
      return outdated.changed;
    } catch (const Error& error) {
      if (error.code() == ExitCode::no_device) throw;
      print_error(context_.err, error.what(), error.hint());
      say_that_it_waits(false);
      files_.watch(renderer_->files_read());
      // What the device was doing may have failed for good; the next attempt opens it anew.
      if (error.code() == ExitCode::run_failed) renderer_ = make_renderer();
      return {};
    }
    files_.watch(renderer_->files_read());
    return {};
  }

  [[nodiscard]] run::RenderEvents events(const Paths& because, Clock::time_point start) {
    run::RenderEvents events;
    events.on_frame = [this, last_look = start](uint32_t done, uint32_t) mutable {
      if (done == 1) files_.watch(renderer_->files_read());
      if (Clock::now() - last_look < kLookEvery) return;
      last_look = Clock::now();
      if (Paths changed = files_.look(); !changed.empty()) throw Outdated{std::move(changed)};
    };
    if (because.empty()) return events;
    events.on_written = [this, because, start](uint32_t frame) {
      if (frame != request_.first_frame) return;
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      std::ostringstream seconds;
      seconds << std::fixed << std::setprecision(2) << elapsed.count();
      context_.err << names_of(because) << " changed: first frame after " << seconds.str() << " s\n" << std::flush;
    };
    return events;
  }

  void say_that_it_waits(bool rendered) {
    context_.err << (rendered ? "watching " : "the pictures stay as they were; watching ")
                 << renderer_->files_read().size() << " files for changes, until Ctrl-C\n"
                 << std::flush;
  }

  Paths wait_for_change() {
    while (true) {
      stop_if_interrupted();
      std::this_thread::sleep_for(kLookEvery);
      if (Paths changed = files_.look(); !changed.empty()) return changed;
    }
  }

  const run::RenderRequest& request_;
  const CommandContext& context_;
  const std::function<void(const run::RenderSummary&)>& report_;
  std::unique_ptr<run::Renderer> renderer_;
  FileWatch files_;
};

}  // namespace

void watch(const run::RenderRequest& request, const CommandContext& context,
           const std::function<void(const run::RenderSummary&)>& report) {
  Watch(request, context, report).run();
}

}  // namespace lightloom::cli
