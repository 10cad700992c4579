// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/MpiProcessGroup.h"

#include "core/Error.h"
#include "processes/MpiMessages.h"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <sched.h>
#include <unistd.h>
#include <utility>

namespace novelview
{
namespace
{
/** Message tags. */
enum Tag
{
  HeaderTag = 7301, ///< to the first process: kind, item, bytes that follow
  BytesTag,         ///< what follows
  ItemTag,          ///< from the first process: the item to make, -1 = there are no more
  GoTag             ///< from the first process: a broadcast comes
};

/** MPI's own waiting keeps a processor busy; here others have work for it. */
void Backoff()
{
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/** The scene of sections that have been received. */
SceneGeometry SceneOf(std::vector<SceneSection> sections)
{
  SceneSource source;
  for (const SceneSection& section : sections)
  {
    source.Names.push_back(section.Name);
  }
  source.Read = [&sections](const std::string& name)
  {
    return std::move(std::find_if(sections.begin(), sections.end(),
      [&name](const SceneSection& each) {
        return each.Name == name;
      })->Bytes);
  };
  source.Where = [](const std::string& name) { return name + " from another process"; };
  return UnpackScene(source);
}
}

MpiProcessGroup::MpiProcessGroup(
  int* argc, char*** argv, const LaunchPlace& place, double rankTimeoutSeconds)
  : Place(place)
  , RankTimeoutSeconds(rankTimeoutSeconds)
{
  // While views are shared out, one thread of the first process talks and another one works; and
  // a third one of every process beats.
  const MpiDeadline deadline("have started", rankTimeoutSeconds);
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_MULTIPLE, &provided);
  this->Controller->Initialize(argc, argv, 1);
  if (rankTimeoutSeconds > 0 && provided == MPI_THREAD_MULTIPLE)
  {
    this->Heartbeat.emplace(rankTimeoutSeconds);
  }
}

MpiProcessGroup::~MpiProcessGroup()
{
  this->Heartbeat.reset();
  const MpiDeadline deadline("have ended", this->RankTimeoutSeconds);
  this->Controller->Finalize(1);
  MPI_Finalize();
}

int MpiProcessGroup::ThreadsHere() const
{
  // mpirun may have bound the process to some processors; those are its own then.
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  const int processors = static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) == 0 && CPU_COUNT(&allowed) < processors)
  {
    return CPU_COUNT(&allowed);
  }
  return std::max(processors / this->Place.SizeHere, 1);
}

void MpiProcessGroup::Share(SceneGeometry& scene)
{
  this->AwaitBroadcast();
  std::vector<SceneSection> sections;
  if (this->Rank() == 0)
  {
    sections = PackScene({ nullptr, scene.Crust, nullptr, scene.Views, {} });
  }
  long long count = static_cast<long long>(sections.size());
  this->Controller->Broadcast(&count, 1, 0);
  sections.resize(static_cast<std::size_t>(count));
  for (SceneSection& section : sections)
  {
    this->Broadcast(section.Name);
    this->Broadcast(section.Bytes);
    if (this->Rank() == 0)
    {
      section.Bytes = {};
    }
  }
  if (this->Rank() != 0)
  {
    scene = SceneOf(std::move(sections));
  }
}

void MpiProcessGroup::ForEach(std::size_t count, const Make& make, const Take& take)
{
  if (this->Rank() != 0)
  {
    this->WorkForOthers(make);
    return;
  }
  this->Count = count;
  this->Next = 0;
  this->Stopped = false;
  std::thread talker([this] { this->DispatchLoop(); });
  try
  {
    this->WorkAsFirst(make, take);
  }
  catch (const Interrupted&)
  {
    this->StopTalking(talker);
    this->ThrowFailure();
    throw;
  }
  catch (...)
  {
    this->StopTalking(talker);
    throw;
  }
  talker.join();
}

bool MpiProcessGroup::ReportFailure(const std::string& text)
{
  if (this->Rank() == 0)
  {
    return false;
  }
  // Short enough that MPI keeps it, should the first process not listen yet.
  this->Send(Failure, 0, text.substr(0, 1000));
  return true;
}

void MpiProcessGroup::EndAll(int code)
{
  MPI_Abort(MPI_COMM_WORLD, code);
}

void MpiProcessGroup::AwaitBroadcast()
{
  char go = 1;
  if (this->Rank() == 0)
  {
    for (int rank = 1; rank < this->Size(); ++rank)
    {
      this->Controller->Send(&go, 1, rank, GoTag);
    }
    return;
  }
  this->AwaitMessage(0, GoTag);
  this->Controller->Receive(&go, 1, 0, GoTag);
}

void MpiProcessGroup::Broadcast(std::string& text)
{
  long long size = static_cast<long long>(text.size());
  this->Controller->Broadcast(&size, 1, 0);
  text.resize(static_cast<std::size_t>(size));
  constexpr long long part = 1 << 28;
  for (long long done = 0; done < size; done += part)
  {
    this->Controller->Broadcast(
      text.data() + done, static_cast<vtkIdType>(std::min(part, size - done)), 0);
  }
}

void MpiProcessGroup::WorkForOthers(const Make& make)
{
  for (;;)
  {
    this->Send(Ask, 0, {});
    this->AwaitMessage(0, ItemTag);
    long long item = -1;
    this->Controller->Receive(&item, 1, 0, ItemTag);
    if (item < 0)
    {
      return;
    }
    this->Send(Made, item, Packed(make(static_cast<std::size_t>(item))));
  }
}

void MpiProcessGroup::Send(Kind kind, long long item, const std::string& bytes)
{
  const long long header[3] = { kind, item, static_cast<long long>(bytes.size()) };
  this->Controller->Send(header, 3, 0, HeaderTag);
  if (!bytes.empty())
  {
    this->Controller->Send(bytes.data(), static_cast<vtkIdType>(bytes.size()), 0, BytesTag);
  }
}

int MpiProcessGroup::AwaitMessage(int from, int tag)
{
  int there = 0;
  int source = from;
  while (this->Controller->Iprobe(from, tag, &there, &source) && !there)
  {
    Backoff();
  }
  return source;
}

void MpiProcessGroup::WorkAsFirst(const Make& make, const Take& take)
{
  std::size_t taken = 0;
  while (taken < this->Count)
  {
    if (const std::size_t item = this->Next++; item < this->Count)
    {
      WorkResult result = make(item);
      const std::lock_guard lock(this->Guard);
      this->Local.emplace(item, std::move(result));
    }
    else
    {
      Backoff();
    }
    this->ThrowFailure();
    while (this->TakeOne(taken, take))
    {
      ++taken;
    }
  }
}

bool MpiProcessGroup::TakeOne(std::size_t item, const Take& take)
{
  WorkResult result;
  std::string bytes;
  {
    const std::lock_guard lock(this->Guard);
    if (auto own = this->Local.extract(item))
    {
      result = std::move(own.mapped());
    }
    else if (auto received = this->Received.extract(item))
    {
      bytes = std::move(received.mapped());
    }
    else
    {
      return false;
    }
  }
  take(item, bytes.empty() ? result : Unpacked(bytes));
  return true;
}

void MpiProcessGroup::DispatchLoop()
{
  int dismissed = 0;
  while (dismissed < this->Size() - 1 && !this->Stopped)
  {
    int there = 0;
    int source = 0;
    this->Controller->Iprobe(vtkMultiProcessController::ANY_SOURCE, HeaderTag, &there, &source);
    if (!there)
    {
      Backoff();
      continue;
    }
    long long header[3] = { 0, 0, 0 };
    this->Controller->Receive(header, 3, source, HeaderTag);
    std::string bytes(static_cast<std::size_t>(header[2]), '\0');
    if (!bytes.empty())
    {
      this->Controller->Receive(
        bytes.data(), static_cast<vtkIdType>(bytes.size()), source, BytesTag);
    }
    dismissed += this->Answer(header, std::move(bytes), source);
  }
}

bool MpiProcessGroup::Answer(const long long* header, std::string bytes, int source)
{
  if (header[0] == Ask)
  {
    const std::size_t next = this->Next++;
    const long long item = next < this->Count ? static_cast<long long>(next) : -1;
    this->Controller->Send(&item, 1, source, ItemTag);
    return item < 0;
  }
  const std::lock_guard lock(this->Guard);
  if (header[0] == Made)
  {
    this->Received.emplace(static_cast<std::size_t>(header[1]), std::move(bytes));
  }
  else if (!this->Failed)
  {
    this->FailureText = std::move(bytes);
    this->Failed = true;
  }
  return false;
}

void MpiProcessGroup::ThrowFailure()
{
  if (this->Failed)
  {
    const std::lock_guard lock(this->Guard);
    const std::size_t colon = this->FailureText.find(": ");
    throw colon == std::string::npos
      ? Error("another process", this->FailureText)
      : Error(this->FailureText.substr(0, colon), this->FailureText.substr(colon + 2));
  }
}

void MpiProcessGroup::StopTalking(std::thread& talker)
{
  this->Stopped = true;
  talker.join();
}

std::unique_ptr<ProcessGroup> StartProcesses(int* argc, char*** argv, double rankTimeoutSeconds)
{
  const LaunchPlace place = FindLaunchPlace();
  if (place.Size == 1)
  {
    return std::make_unique<ProcessGroup>();
  }
  return std::make_unique<MpiProcessGroup>(argc, argv, place, rankTimeoutSeconds);
}
}
