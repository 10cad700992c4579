// SPDX-License-Identifier: GPL-3.0-or-later
// Several processes, by VTK's controller over MPI. Compiled only where there is MPI.
#ifndef novelview_MpiProcessGroup_h
#define novelview_MpiProcessGroup_h

#include "processes/MpiHeartbeat.h"
#include "processes/ProcessGroup.h"

#include <vtkMPIController.h>
#include <vtkNew.h>

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace novelview
{
/** The processes of mpirun. */
class MpiProcessGroup : public ProcessGroup
{
public:
  MpiProcessGroup(int* argc, char*** argv, const LaunchPlace& place, double rankTimeoutSeconds);
  ~MpiProcessGroup() override;

  int Rank() const override { return this->Controller->GetLocalProcessId(); }
  int Size() const override { return this->Controller->GetNumberOfProcesses(); }

  int ThreadsHere() const override;
  void Share(SceneGeometry& scene) override;
  void ForEach(std::size_t count, const Make& make, const Take& take) override;
  bool OtherFailed() const override { return this->Failed; }

  bool ReportFailure(const std::string& text) override;
  void EndAll(int code) override;

private:
  /** A message of a process to the first one. */
  enum Kind : long long
  {
    Ask,    ///< it has nothing to do
    Made,   ///< the result of an item
    Failure ///< an error's text
  };

  // ---- from the first process to all

  /** All but the first sleep until there is something to receive. */
  void AwaitBroadcast();

  /** The first process's text in all of them; in parts, since MPI counts in 32 bits. */
  void Broadcast(std::string& text);

  // ---- the other processes

  void WorkForOthers(const Make& make);

  void Send(Kind kind, long long item, const std::string& bytes);

  /** Sleeps until there is a message; returns whose. */
  int AwaitMessage(int from, int tag);

  // ---- the first process

  void WorkAsFirst(const Make& make, const Take& take);

  /** Takes the item if it is made. */
  bool TakeOne(std::size_t item, const Take& take);

  /** Answers the other processes until each knows that there is no more work. */
  void DispatchLoop();

  /** Returns whether the answer was that there is no more work. */
  bool Answer(const long long* header, std::string bytes, int source);

  void ThrowFailure();

  void StopTalking(std::thread& talker);

  const LaunchPlace Place;
  const double RankTimeoutSeconds;
  std::optional<MpiHeartbeat> Heartbeat;
  vtkNew<vtkMPIController> Controller;
  std::atomic<std::size_t> Next{ 0 }; ///< the first item that is not assigned
  std::size_t Count = 0;
  std::atomic<bool> Stopped{ false };
  std::atomic<bool> Failed{ false };
  std::mutex Guard; ///< of what follows
  std::string FailureText;
  std::map<std::size_t, WorkResult> Local; ///< made in this process
  std::map<std::size_t, std::string> Received;
};
}

#endif
