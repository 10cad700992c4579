// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Console_h
#define novelview_Console_h

#include <spdlog/logger.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace novelview
{
enum class Verbosity
{
  Silent, ///< nothing: another process prints the same
  Quiet,  ///< warnings and errors
  Normal, ///< and progress, stages, results
  Verbose ///< and details
};

/**
 * The output of the program: messages and progress on `out`, warnings and errors on `err`, one
 * line each. On a terminal progress is a bar on a separate line, with the time since the start,
 * which advances while nothing is reported; otherwise only whole lines are written, one when a
 * stage ends. For the main thread only, except Progress().
 */
class Console
{
public:
  explicit Console(Verbosity verbosity, std::FILE* out = stdout, std::FILE* err = stderr);
  ~Console();

  /** Something has been worked on up to a fraction, 0 to 1. Returns false after Interrupt(). */
  bool Progress(const std::string& what, double fraction);
  /** Progress() of one task, for callers that need not check for a requested stop. */
  std::function<void(double fraction)> ProgressOf(const std::string& what)
  {
    return [this, what](double fraction) { this->Progress(what, fraction); };
  }
  /** A stage has ended. */
  void StageDone(const std::string& stage, double seconds);
  /** Two stages ran at the same time, in this many seconds less than the sum of both. */
  void StagesOverlapped(double seconds) { this->Overlap += seconds; }
  /** Does what is no filter's work, with a bar, and counts it as a stage. */
  void RunTimed(const std::string& stage, const std::function<void()>& work);

  /** Whether nothing but warnings and errors is written. */
  bool IsQuiet() const;
  void Info(const std::string& text);
  void Detail(const std::string& text);
  void Warn(const std::string& text);
  void Error(const std::string& text);

  /** The seconds of every stage so far, in the order of their ends; a stage that ran again adds
   * up. */
  const std::vector<std::pair<std::string, double>>& StageSeconds() const { return this->Stages; }
  /** Prints the time of every stage, the total time and the peak memory. */
  void Summary();
  /**
   * The same for programs, as a JSON object: "stages" (an object of "seconds" by stage, in the
   * order of their ends), "overlap" (seconds by which their sum is too large, since some ran at the
   * same time), "whole" (seconds since the Console was made), "threads" and "peakMemoryMiB".
   */
  std::string TimingsText() const;

  /** Requests every Console to stop its program; may be called by a signal handler. */
  static void Interrupt();
  static bool Interrupted();

private:
  void DrawBar();
  void DrawBarUntilEnd();
  void ClearBar();
  double SecondsSoFar() const;

  std::shared_ptr<spdlog::logger> Out;
  std::shared_ptr<spdlog::logger> Err;
  std::shared_ptr<spdlog::logger> Before; ///< spdlog's default logger while there is no Console
  std::FILE* Terminal = nullptr;          ///< where the bar is drawn; null = nowhere
  std::mutex BarMutex;                    ///< of the four below
  std::string What;                       ///< the bar's text; none = no bar
  double Fraction = 0;                    ///< its length
  std::string Bar;                        ///< as drawn last
  bool Ended = false;
  std::condition_variable End;
  std::thread Clock; ///< draws the bar while nothing is reported
  std::vector<std::pair<std::string, double>> Stages;
  double Overlap = 0;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

/** The most memory this process has held so far, in MiB. */
double PeakMemoryMiB();
}

#endif
