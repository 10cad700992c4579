// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/Console.h"

#include "Threads.h"
#include "base/JsonFile.h"
#include "core/PrintableText.h"
#include "core/ToInt.h"

#include <nlohmann/json.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <sys/resource.h>
#include <unistd.h>

namespace novelview
{
namespace
{
std::atomic<bool> InterruptRequested = false;

/** A logger that is not one of spdlog's global ones and writes lines unchanged. */
std::shared_ptr<spdlog::logger> LinesTo(std::FILE* file, const char* pattern)
{
  using Sink = spdlog::sinks::stdout_sink_base<spdlog::details::console_mutex>;
  struct FileSink : Sink
  {
    explicit FileSink(std::FILE* to)
      : Sink(to)
    {
    }
  };
  auto logger = std::make_shared<spdlog::logger>("novelview", std::make_shared<FileSink>(file));
  logger->set_pattern(pattern);
  logger->flush_on(spdlog::level::trace);
  return logger;
}
}

Console::Console(Verbosity verbosity, std::FILE* out, std::FILE* err)
  : Out(LinesTo(out, "%v"))
  , Err(LinesTo(err, "novelview: %l: %v"))
{
  this->Err->set_level(verbosity == Verbosity::Silent ? spdlog::level::off : spdlog::level::trace);
  this->Out->set_level(verbosity <= Verbosity::Quiet
      ? spdlog::level::off
      : (verbosity == Verbosity::Verbose ? spdlog::level::debug : spdlog::level::info));
  if (verbosity > Verbosity::Quiet && ::isatty(::fileno(out)))
  {
    this->Terminal = out;
    this->Clock = std::thread([this] { this->DrawBarUntilEnd(); });
  }
  SetStopFlag(&InterruptRequested);
  // Messages of the layers below are printed in the same way and at the same verbosity.
  this->Before = spdlog::default_logger();
  spdlog::set_default_logger(this->Out);
}

Console::~Console()
{
  this->ClearBar();
  if (this->Clock.joinable())
  {
    {
      const std::lock_guard<std::mutex> lock(this->BarMutex);
      this->Ended = true;
    }
    this->End.notify_all();
    this->Clock.join();
  }
  spdlog::set_default_logger(this->Before);
}

bool Console::Progress(const std::string& what, double fraction)
{
  if (this->Terminal)
  {
    const std::lock_guard<std::mutex> lock(this->BarMutex);
    this->What = what;
    this->Fraction = ClampedNumber(fraction, 0, 1);
    this->DrawBar();
  }
  return !Interrupted();
}

void Console::DrawBar()
{
  constexpr int width = 30;
  const int full = static_cast<int>(this->Fraction * width);
  const std::string bar = fmt::format("[{:#<{}}{:.<{}}] {:3.0f} % {}, {:.1f} s", "", full, "",
    width - full, 100 * this->Fraction, this->What, this->SecondsSoFar());
  if (bar != this->Bar)
  {
    std::fprintf(this->Terminal, "\r\x1b[K%s", bar.c_str());
    std::fflush(this->Terminal);
    this->Bar = bar;
  }
}

void Console::DrawBarUntilEnd()
{
  std::unique_lock<std::mutex> lock(this->BarMutex);
  while (!this->End.wait_for(lock, std::chrono::milliseconds(200), [this] { return this->Ended; }))
  {
    if (!this->What.empty())
    {
      this->DrawBar();
    }
  }
}

void Console::ClearBar()
{
  const std::lock_guard<std::mutex> lock(this->BarMutex);
  this->What.clear();
  if (this->Terminal && !this->Bar.empty())
  {
    std::fputs("\r\x1b[K", this->Terminal);
    std::fflush(this->Terminal);
    this->Bar.clear();
  }
}

void Console::StageDone(const std::string& stage, double seconds)
{
  const auto known = std::find_if(this->Stages.begin(), this->Stages.end(),
    [&stage](const auto& each) { return each.first == stage; });
  if (known == this->Stages.end())
  {
    this->Stages.emplace_back(stage, seconds);
  }
  else
  {
    known->second += seconds;
  }
  this->Info(fmt::format("{} done in {:.2f} s", stage, seconds));
}

void Console::RunTimed(const std::string& stage, const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  this->Progress(stage, 0);
  work();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  this->StageDone(stage, taken.count());
}

bool Console::IsQuiet() const
{
  return !this->Out->should_log(spdlog::level::info);
}

void Console::Info(const std::string& text)
{
  this->ClearBar();
  this->Out->info("{}", Printable(text));
}

void Console::Detail(const std::string& text)
{
  this->ClearBar();
  this->Out->debug("{}", Printable(text));
}

void Console::Warn(const std::string& text)
{
  this->ClearBar();
  this->Err->warn("{}", PrintableLine(text));
}

void Console::Error(const std::string& text)
{
  this->ClearBar();
  this->Err->error("{}", PrintableLine(text));
}

void Console::Summary()
{
  for (const auto& [stage, seconds] : this->Stages)
  {
    this->Info(fmt::format("  {:<24} {:8.2f} s", stage, seconds));
  }
  if (this->Overlap > 0)
  {
    this->Info(fmt::format("  {:<24} {:8.2f} s", "at the same time", -this->Overlap));
  }
  this->Info(fmt::format("  {:<24} {:8.2f} s", "whole run", this->SecondsSoFar()));
  this->Info(fmt::format("  {:<24} {:8.0f} MiB", "peak memory", PeakMemoryMiB()));
}

std::string Console::TimingsText() const
{
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [stage, seconds] : this->Stages)
  {
    stages[stage] = seconds;
  }
  const nlohmann::ordered_json timings = { { "stages", stages }, { "overlap", this->Overlap },
    { "whole", this->SecondsSoFar() }, { "threads", NumberOfThreads() },
    { "peakMemoryMiB", PeakMemoryMiB() } };
  return DumpJson(timings) + "\n";
}

double Console::SecondsSoFar() const
{
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - this->Start;
  return whole.count();
}

void Console::Interrupt()
{
  InterruptRequested = true;
}

bool Console::Interrupted()
{
  return InterruptRequested;
}

double PeakMemoryMiB()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024; // Linux counts in KiB
}
}
