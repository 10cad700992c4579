// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/LiveServer.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "live/LivePage.h"

#include <httplib.h>

#include <mutex>
#include <random>
#include <semaphore>
#include <thread>
#include <utility>

namespace novelview
{
namespace
{
constexpr int HandlerThreads = 32; // they wait for clients and for the worker, most of the time
constexpr int AcceptedConnections = 64;
constexpr int WaitingConnections = 128;
constexpr int SecondsForOneRequest = 2;

/** 128 random bits as hexadecimal digits. */
std::string RandomToken()
{
  constexpr int Digits = 32;
  std::random_device random;
  std::string token;
  for (int i = 0; i < Digits; ++i)
  {
    token += "0123456789abcdef"[random() % 16];
  }
  return token;
}

/** A Host without its port, which differs behind a forwarded one. */
std::string WithoutPort(const std::string& host)
{
  const std::size_t colon = host.rfind(':');
  const bool hasPort = colon != std::string::npos && host.find(']', colon) == std::string::npos;
  return hasPort ? host.substr(0, colon) : host;
}

int StatusOf(FrameAnswer::Kind what)
{
  switch (what)
  {
    case FrameAnswer::Kind::Made:
      return 200;
    case FrameAnswer::Kind::Replaced:
      return 409;
    case FrameAnswer::Kind::Failed:
      return 422;
    default:
      return 503;
  }
}

void SetText(httplib::Response& response, int status, const std::string& text)
{
  response.status = status;
  response.set_content(text, "text/plain; charset=utf-8");
}
}

/** The library's threads. Of more connections than AcceptedConnections none is accepted. */
class BoundedThreadPool : public httplib::TaskQueue
{
public:
  void enqueue(std::function<void()> work) override
  {
    // Called by the thread that accepts connections; those that wait are the system's to bound.
    this->Places.acquire();
    this->Threads.enqueue(
      [this, work = std::move(work)]
      {
        work();
        this->Places.release();
      });
  }
  void shutdown() override { this->Threads.shutdown(); }

private:
  httplib::ThreadPool Threads{ HandlerThreads };
  std::counting_semaphore<AcceptedConnections> Places{ AcceptedConnections };
};

class LiveServer::Internals
{
public:
  /** Whether a request comes from the page, on this computer. */
  bool IsAllowed(const httplib::Request& request) const
  {
    const std::string host = request.get_header_value("Host");
    const std::string name = WithoutPort(host);
    const std::string origin = request.get_header_value("Origin");
    const std::string token =
      request.path == "/" ? request.get_param_value("token") : request.get_header_value("X-Token");
    // A name that someone else's server has may lead here, too (DNS rebinding).
    const bool own = name == "127.0.0.1" || name == "localhost" || name == "[::1]";
    return (own || !this->IsLoopback()) && (origin.empty() || origin == "http://" + host) &&
      token == this->Token;
  }

  bool IsLoopback() const { return this->Address == "127.0.0.1" || this->Address == "localhost"; }

  void AnswerFrame(const httplib::Request& request, httplib::Response& response)
  {
    FrameRequest wanted;
    try
    {
      wanted = ParseFrameRequest(request.body);
    }
    catch (const Error& error)
    {
      SetText(response, 400, error.what());
      return;
    }
    const FrameAnswer answer = this->Frames.Ask(wanted);
    SetText(response, StatusOf(answer.What), answer.Text);
    if (answer.Point)
    {
      response.set_header("X-Point",
        NumberText(answer.Point->x()) + " " + NumberText(answer.Point->y()) + " " +
          NumberText(answer.Point->z()));
    }
    if (answer.What == FrameAnswer::Kind::Made)
    {
      response.set_content(
        reinterpret_cast<const char*>(answer.Png.data()), answer.Png.size(), "image/png");
    }
  }

  void AnswerPhotograph(const httplib::Request& request, httplib::Response& response)
  {
    std::size_t number = 0;
    const std::lock_guard lock(this->StateMutex);
    if (!ParseNumber(request.get_param_value("number"), number) ||
      number >= this->Thumbnails.size())
    {
      SetText(response, 404, "no photograph of this number\n");
      return;
    }
    const std::vector<std::uint8_t>& jpeg = this->Thumbnails[number];
    response.set_content(reinterpret_cast<const char*>(jpeg.data()), jpeg.size(), "image/jpeg");
  }

  void Configure()
  {
    this->Server.new_task_queue = [] { return new BoundedThreadPool(); };
    // Without SO_REUSEPORT, by which two programs would share a port.
    this->Server.set_socket_options(
      [this](socket_t socket)
      {
        const int yes = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
        this->Socket = socket;
      });
    this->Server.set_payload_max_length(LargestBodyBytes);
    this->Server.set_read_timeout(SecondsForOneRequest);
    this->Server.set_write_timeout(SecondsForOneRequest);
    // An idle connection would keep a thread.
    this->Server.set_keep_alive_max_count(1);
    this->Server.set_keep_alive_timeout(1);
    this->Server.set_default_headers({ { "Cache-Control", "no-store" },
      { "Referrer-Policy", "no-referrer" }, { "X-Content-Type-Options", "nosniff" },
      { "Content-Security-Policy",
        "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
        "img-src blob:; connect-src 'self'; frame-ancestors 'none'" } });
    this->Server.set_pre_routing_handler(
      [this](const httplib::Request& request, httplib::Response& response)
      {
        if (this->IsAllowed(request))
        {
          return httplib::Server::HandlerResponse::Unhandled;
        }
        SetText(response, 403, "forbidden: use the address that novelview view printed\n");
        return httplib::Server::HandlerResponse::Handled;
      });
    this->Server.Get("/",
      [](const httplib::Request&, httplib::Response& response)
      { response.set_content(LivePageText, "text/html; charset=utf-8"); });
    this->Server.Get("/state",
      [this](const httplib::Request&, httplib::Response& response)
      {
        const std::lock_guard lock(this->StateMutex);
        response.set_content(this->State, "application/json");
      });
    this->Server.Get("/photograph",
      [this](const httplib::Request& request, httplib::Response& response)
      { this->AnswerPhotograph(request, response); });
    this->Server.Post("/frame",
      [this](const httplib::Request& request, httplib::Response& response)
      { this->AnswerFrame(request, response); });
  }

  std::string Address;
  int Port = 0;
  socket_t Socket = INVALID_SOCKET;
  std::string Token = RandomToken();
  FrameQueue Frames;
  std::mutex StateMutex;
  std::string State = "{}";
  std::vector<std::vector<std::uint8_t>> Thumbnails;
  httplib::Server Server;
  std::thread Listener;
};

LiveServer::LiveServer(const std::string& address, int port)
  : Impl(std::make_unique<Internals>())
{
  Internals& impl = *this->Impl;
  impl.Address = address;
  impl.Configure();
  const bool bound = port == 0 ? (impl.Port = impl.Server.bind_to_any_port(address)) > 0
                               : impl.Server.bind_to_port(address, port);
  if (!bound)
  {
    throw Error(address + ":" + std::to_string(port), "cannot listen at this address and port");
  }
  // The library lets five connections wait; of a burst of more, some would be reset.
  ::listen(impl.Socket, WaitingConnections);
  impl.Port = port == 0 ? impl.Port : port;
  impl.Listener = std::thread([&impl] { impl.Server.listen_after_bind(); });
  while (!impl.Server.is_running())
  {
    std::this_thread::yield();
  }
}

LiveServer::~LiveServer()
{
  this->Impl->Frames.Close();
  this->Impl->Server.stop();
  this->Impl->Listener.join();
}

int LiveServer::Port() const
{
  return this->Impl->Port;
}

const std::string& LiveServer::Token() const
{
  return this->Impl->Token;
}

std::string LiveServer::Address() const
{
  return "http://" + this->Impl->Address + ":" + std::to_string(this->Impl->Port) +
    "/?token=" + this->Impl->Token;
}

void LiveServer::SetState(std::string json)
{
  const std::lock_guard lock(this->Impl->StateMutex);
  this->Impl->State = std::move(json);
}

void LiveServer::SetThumbnails(std::vector<std::vector<std::uint8_t>> jpegs)
{
  const std::lock_guard lock(this->Impl->StateMutex);
  this->Impl->Thumbnails = std::move(jpegs);
}

FrameQueue& LiveServer::Frames()
{
  return this->Impl->Frames;
}
}
