// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/MpiHeartbeat.h"

#include "base/NumberText.h"
#include "base/OutOfMemory.h"
#include "processes/ProcessGroup.h"

#include <algorithm>
#include <atomic>
#include <chrono>

namespace novelview
{
namespace
{
using Clock = std::chrono::steady_clock;

constexpr int BeatTag = 7401;

// Read by signal handlers.
std::atomic<double> LastPass = -1; ///< seconds of Clock; below 0 = there is no heartbeat
std::atomic<double> LongestStandstill = 0;
std::atomic<double> Timeout = 0;

double Now()
{
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

/** The message of a beat. */
enum Beat : char
{
  Alive,
  Last ///< no more beats will come
};

double PeriodOf(double timeoutSeconds)
{
  return std::clamp(timeoutSeconds / 10, 0.05, 1.0);
}

std::chrono::duration<double> Seconds(double seconds)
{
  return std::chrono::duration<double>(seconds);
}
}

MpiHeartbeat::MpiHeartbeat(double timeoutSeconds)
  : TimeoutSeconds(timeoutSeconds)
  , PeriodSeconds(PeriodOf(timeoutSeconds))
{
  int size = 1;
  MPI_Comm_dup(MPI_COMM_WORLD, &this->Beats);
  MPI_Comm_rank(this->Beats, &this->Rank);
  MPI_Comm_size(this->Beats, &size);
  const int first = this->Rank == 0 ? 1 : 0;
  const int last = this->Rank == 0 ? size - 1 : 0;
  for (int rank = first; rank <= last; ++rank)
  {
    this->Peers.emplace_back().Rank = rank;
  }
  this->Thread = std::thread([this] { this->Run(); });
}

MpiHeartbeat::~MpiHeartbeat()
{
  // Beats continue until no process waits for them.
  MPI_Request barrier = MPI_REQUEST_NULL;
  MPI_Ibarrier(this->Beats, &barrier);
  for (int done = 0; !done;)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    MPI_Test(&barrier, &done, MPI_STATUS_IGNORE);
  }
  {
    const std::lock_guard lock(this->Guard);
    this->Leaving = true;
  }
  this->Wake.notify_all();
  this->Thread.join();
  for (Peer& peer : this->Peers)
  {
    MPI_Wait(&peer.Sending, MPI_STATUS_IGNORE);
  }
  MPI_Comm_free(&this->Beats);
}

void MpiHeartbeat::Run()
{
  Timeout = this->TimeoutSeconds;
  LastPass = Now();
  while (!this->Pause())
  {
    const double now = Now();
    const double passed = now - LastPass;
    LongestStandstill = std::max<double>(LongestStandstill, passed);
    LastPass = now;
    this->Listen();
    this->Judge(passed);
    this->Send(Alive);
  }
  LastPass = -1;
  // So that no beat is left over when MPI ends.
  for (Peer& peer : this->Peers)
  {
    MPI_Wait(&peer.Sending, MPI_STATUS_IGNORE);
  }
  this->Send(Last);
  while (!this->AllLeft())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    this->Listen();
  }
}

/** Sleeps until the next beat; returns whether there are to be no more. */
bool MpiHeartbeat::Pause()
{
  std::unique_lock lock(this->Guard);
  return this->Wake.wait_for(lock, Seconds(this->PeriodSeconds), [this] { return this->Leaving; });
}

void MpiHeartbeat::Send(char beat)
{
  for (Peer& peer : this->Peers)
  {
    // A peer that does not listen must not hold this process up.
    int sent = 0;
    MPI_Test(&peer.Sending, &sent, MPI_STATUS_IGNORE);
    if (sent)
    {
      peer.Beat = beat;
      MPI_Isend(&peer.Beat, 1, MPI_CHAR, peer.Rank, BeatTag, this->Beats, &peer.Sending);
    }
  }
}

void MpiHeartbeat::Listen()
{
  for (;;)
  {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, BeatTag, this->Beats, &there, &status);
    if (!there)
    {
      return;
    }
    char beat = Alive;
    MPI_Recv(&beat, 1, MPI_CHAR, status.MPI_SOURCE, BeatTag, this->Beats, MPI_STATUS_IGNORE);
    const auto peer = std::find_if(this->Peers.begin(), this->Peers.end(),
      [&status](const Peer& each) { return each.Rank == status.MPI_SOURCE; });
    if (peer != this->Peers.end())
    {
      peer->SilentSeconds = 0;
      peer->Left = beat == Last;
    }
  }
}

void MpiHeartbeat::Judge(double passedSeconds)
{
  // All but the first listen to the first; one of them shall speak.
  const double patience = this->TimeoutSeconds + std::max(this->Rank - 1, 0);
  for (Peer& peer : this->Peers)
  {
    peer.SilentSeconds += std::min(passedSeconds, 2 * this->PeriodSeconds);
    if (!peer.Left && peer.SilentSeconds > patience)
    {
      const std::string text = "process " + std::to_string(peer.Rank) + " of mpirun: silent for " +
        Formatted("%.0f s, which ends all (--rank-timeout)", peer.SilentSeconds);
      PrintLastError(text.c_str());
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  }
}

bool MpiHeartbeat::AllLeft() const
{
  return std::all_of(
    this->Peers.begin(), this->Peers.end(), [](const Peer& peer) { return peer.Left; });
}

bool StoodStillTooLong()
{
  const double last = LastPass;
  return last >= 0 && std::max<double>(LongestStandstill, Now() - last) > Timeout;
}

MpiDeadline::MpiDeadline(const std::string& what, double timeoutSeconds)
{
  if (timeoutSeconds <= 0)
  {
    return;
  }
  this->Thread = std::thread(
    [this, what, timeoutSeconds]
    {
      // By passes, not by the clock: time in which this process itself stood still does not count.
      const double period = PeriodOf(timeoutSeconds);
      std::unique_lock lock(this->Guard);
      for (double passed = 0; passed < timeoutSeconds; passed += period)
      {
        if (this->Wake.wait_for(lock, Seconds(period), [this] { return this->Reached; }))
        {
          return;
        }
      }
      const std::string text = "mpirun: not all processes " + what +
        Formatted(" within %.0f s, which ends all (--rank-timeout)", timeoutSeconds);
      EndWithError(text.c_str()); // and mpirun ends the others
    });
}

MpiDeadline::~MpiDeadline()
{
  if (this->Thread.joinable())
  {
    {
      const std::lock_guard lock(this->Guard);
      this->Reached = true;
    }
    this->Wake.notify_all();
    this->Thread.join();
  }
}
}
