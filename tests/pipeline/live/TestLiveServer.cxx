// SPDX-License-Identifier: GPL-3.0-or-later
#include "live/LiveServer.h"
#include "support/MessageOf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <memory>
#include <thread>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

using namespace novelview;
using namespace std::chrono_literals;
using testing::HasSubstr;

namespace
{
const char* const Request = R"({"K":[300,0,79.5,0,300,59.5,0,0,1],"R":[1,0,0,0,1,0,0,0,1],)"
                            R"("T":[0,0,3],"width":160,"height":120,"stage":"full"})";

/** A client that connects and then says nothing. */
class IdleConnection
{
public:
  explicit IdleConnection(int port)
    : Socket(::socket(AF_INET, SOCK_STREAM, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::connect(this->Socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
  }
  ~IdleConnection() { ::close(this->Socket); }
  IdleConnection(const IdleConnection&) = delete;
  IdleConnection& operator=(const IdleConnection&) = delete;

private:
  int Socket;
};

/** A server, and a worker that answers every request with one byte. */
class LiveServerTest : public testing::Test
{
protected:
  LiveServerTest()
    : Worker(
        [this]
        {
          while (!this->Ended)
          {
            if (const auto ticket = this->Server.Frames().Take(10ms))
            {
              FrameAnswer answer{ FrameAnswer::Kind::Made, { 42 }, "", {} };
              if (ticket->Request.Pick)
              {
                answer.Point = Eigen::Vector3d(0.5, -1, 2);
              }
              this->Server.Frames().Give(ticket, answer);
            }
          }
        })
  {
  }
  ~LiveServerTest() override
  {
    this->Ended = true;
    this->Worker.join();
  }

  httplib::Client Client() const { return httplib::Client("127.0.0.1", this->Server.Port()); }
  httplib::Headers WithToken(httplib::Headers more = {}) const
  {
    more.emplace("X-Token", this->Server.Token());
    return more;
  }
  int StatusOfFrame(const httplib::Headers& headers, const std::string& body = Request) const
  {
    const auto answer = this->Client().Post("/frame", headers, body, "application/json");
    return answer ? answer->status : -1;
  }

  LiveServer Server{ "127.0.0.1", 0 };
  std::atomic<bool> Ended = false;
  std::thread Worker;
};
}

TEST_F(LiveServerTest, ItsAddressOpensThePage)
{
  const std::string address = this->Server.Address();
  const std::string path = address.substr(address.find("/?"));
  const auto page = this->Client().Get(path);
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, HasSubstr("<title>NovelView</title>"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'"));
}

TEST_F(LiveServerTest, AFrameIsWhatTheWorkerMade)
{
  const auto frame = this->Client().Post("/frame", this->WithToken(), Request, "application/json");
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->status, 200);
  EXPECT_EQ(frame->body, "*");
  EXPECT_EQ(frame->get_header_value("Content-Type"), "image/png");
}

TEST_F(LiveServerTest, TheStateIsWhatWasSetLast)
{
  this->Server.SetState(R"({"stage":"hull"})");
  const auto state = this->Client().Get("/state", this->WithToken());
  ASSERT_TRUE(state);
  EXPECT_EQ(state->body, R"({"stage":"hull"})");
}

TEST_F(LiveServerTest, WithoutTheTokenNothingIsAnswered)
{
  EXPECT_EQ(this->StatusOfFrame({}), 403);
  EXPECT_EQ(this->StatusOfFrame({ { "X-Token", std::string(32, '0') } }), 403);
  EXPECT_EQ(this->Client().Get("/")->status, 403);
  EXPECT_EQ(this->Client().Get("/state")->status, 403);
  EXPECT_EQ(this->Client().Get("/elsewhere")->status, 403);
}

TEST_F(LiveServerTest, APageOfAnotherSiteIsRefusedEvenWithTheToken)
{
  const std::string own = "127.0.0.1:" + std::to_string(this->Server.Port());
  EXPECT_EQ(this->StatusOfFrame(this->WithToken({ { "Host", "evil.example" } })), 403);
  EXPECT_EQ(this->StatusOfFrame(this->WithToken({ { "Origin", "http://evil.example" } })), 403);
  EXPECT_EQ(this->StatusOfFrame(this->WithToken({ { "Origin", "http://" + own } })), 200);
}

TEST_F(LiveServerTest, MalformedAndHugeRequestsAreRefused)
{
  EXPECT_EQ(this->StatusOfFrame(this->WithToken(), "{"), 400);
  EXPECT_EQ(this->StatusOfFrame(this->WithToken(), ""), 400);
  EXPECT_EQ(
    this->StatusOfFrame(this->WithToken(), std::string(LiveServer::LargestBodyBytes + 1, ' ')),
    413);
  EXPECT_EQ(this->StatusOfFrame(this->WithToken()), 200) << "and the next one is answered";
}

TEST_F(LiveServerTest, ManyClientsAtOnceAreAllAnswered)
{
  std::atomic<int> answered = 0;
  std::vector<std::thread> clients;
  for (int i = 0; i < 40; ++i)
  {
    clients.emplace_back(
      [&]
      {
        const int status = this->StatusOfFrame(this->WithToken());
        EXPECT_TRUE(status == 200 || status == 409) << status;
        ++answered;
      });
  }
  for (std::thread& client : clients)
  {
    client.join();
  }
  EXPECT_EQ(answered, 40);
}

TEST_F(LiveServerTest, TheSurfacePointOfAPickedPixelIsAHeader)
{
  std::string request = Request;
  request.insert(1, R"("pick":[3,4],)");
  const auto answer = this->Client().Post("/frame", this->WithToken(), request, "application/json");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->get_header_value("X-Point"), "0.5 -1 2");
  EXPECT_FALSE(this->Client()
                 .Post("/frame", this->WithToken(), Request, "application/json")
                 ->has_header("X-Point"));
}

TEST_F(LiveServerTest, PhotographsAreThoseThatWereSet)
{
  this->Server.SetThumbnails({ { 1, 2 }, { 3 } });
  EXPECT_EQ(this->Client().Get("/photograph?number=1", this->WithToken())->body, "\x03");
  for (const char* number : { "2", "-1", "x", "" })
  {
    const auto answer =
      this->Client().Get(std::string("/photograph?number=") + number, this->WithToken());
    EXPECT_EQ(answer->status, 404) << number;
  }
  EXPECT_EQ(this->Client().Get("/photograph?number=1")->status, 403);
}

TEST_F(LiveServerTest, IdleConnectionsDoNotKeepOthersOut)
{
  std::vector<std::unique_ptr<IdleConnection>> idle;
  for (int i = 0; i < 150; ++i) // more than are accepted at a time
  {
    idle.push_back(std::make_unique<IdleConnection>(this->Server.Port()));
  }
  httplib::Client client("127.0.0.1", this->Server.Port());
  client.set_read_timeout(60);
  const auto answer = client.Post("/frame", this->WithToken(), Request, "application/json");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
}

TEST_F(LiveServerTest, APortInUseIsAnError)
{
  EXPECT_THAT(MessageOf([this] { LiveServer("127.0.0.1", this->Server.Port()); }),
    HasSubstr("127.0.0.1:" + std::to_string(this->Server.Port()) + ": cannot listen"));
}
