// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MpiHeartbeat_h
#define novelview_MpiHeartbeat_h

#include <mpi.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace novelview
{
/**
 * Ends all processes of a run when one of them stops without dying (SIGSTOP, a machine that hangs).
 * A thread in every process sends beats: the first process to all others, these to the first. Who
 * receives nothing for too long prints one line and calls MPI_Abort. The thread beats during long
 * stages as well, so only silence counts, not work. Time in which this process itself stood still
 * is no silence of others. Needs MPI_THREAD_MULTIPLE.
 */
class MpiHeartbeat
{
public:
  /** Begins; all processes do so together. */
  explicit MpiHeartbeat(double timeoutSeconds);
  /** Waits until all processes have come here, and ends. */
  ~MpiHeartbeat();
  MpiHeartbeat(const MpiHeartbeat&) = delete;
  void operator=(const MpiHeartbeat&) = delete;

private:
  /** A process that this one listens to. */
  struct Peer
  {
    int Rank = 0;
    double SilentSeconds = 0;
    bool Left = false; ///< it has announced its last beat
    char Beat = 0;     ///< what is being sent to it
    MPI_Request Sending = MPI_REQUEST_NULL;
  };

  void Run();
  bool Pause();
  void Send(char beat);
  void Listen();
  void Judge(double passedSeconds);
  bool AllLeft() const;

  const double TimeoutSeconds;
  const double PeriodSeconds;
  MPI_Comm Beats =
    MPI_COMM_NULL; ///< a separate one, so that no other message is mistaken for a beat
  int Rank = 0;
  std::vector<Peer> Peers;
  std::mutex Guard;
  std::condition_variable Wake;
  bool Leaving = false; ///< all processes have come to the end
  std::thread Thread;
};

/**
 * Ends this process, and with it the run, when what needs all processes takes too long: for where
 * MPI allows no messages, at its start and end.
 */
class MpiDeadline
{
public:
  /** @param what the processes have to do, as in "not all processes `what`".
   *  @param timeoutSeconds 0 = never. */
  MpiDeadline(const std::string& what, double timeoutSeconds);
  ~MpiDeadline();
  MpiDeadline(const MpiDeadline&) = delete;
  void operator=(const MpiDeadline&) = delete;

private:
  std::mutex Guard;
  std::condition_variable Wake;
  bool Reached = false; ///< in time
  std::thread Thread;
};
}

#endif
