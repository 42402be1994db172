// SPDX-License-Identifier: Apache-2.0
// Pages that draw nothing, for bench/gui_load.py: they take frames over WebSockets, acknowledge
// them, and note how old each one is. Some read slowly, and some stop reading.
//
//   bench_gui_clients PORT COOKIE AUTHORITY|- CLIENTS STALLED SLOW SLOW_BYTES_PER_S HZ WARM_S
//   SPAN_S
//
// Prints `begin` when the measured span begins, and one line of JSON when it has ended.
#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

enum class Habit : std::uint8_t { kPrompt, kSlow, kStalled };

std::uint32_t now_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

struct Settings {
  std::uint16_t port = 0;
  std::string cookie;
  SSL_CTX* tls = nullptr;
  double hz = 30;
  double slow_bytes_per_s = 0;
};

/// A line of a page. Throws std::runtime_error if the server ends it.
class Line {
 public:
  Line(const Settings& settings, Habit habit) : settings_(settings), habit_(habit) {
    connect();
    upgrade();
    ::fcntl(fd_, F_SETFL, O_NONBLOCK);
    send(fmt::format(R"({{"type":"look","poses":true,"true_poses":false,"readings":[],)"
                     R"("parts":false,"max_hz":{}}})",
                     settings.hz));
    read_at_ = Clock::now();
  }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() {
    if (tls_ != nullptr) SSL_free(tls_);
    ::close(fd_);
  }

  [[nodiscard]] int fd() const noexcept { return fd_; }
  [[nodiscard]] Habit habit() const noexcept { return habit_; }
  std::vector<std::int32_t> ages_us;
  std::vector<double> arrivals_s;

  /// Reads all that is there, or what a slow line lets through.
  void read() {
    char piece[65536];
    std::size_t most = ~std::size_t{0};
    if (habit_ == Habit::kSlow) {
      const auto now = Clock::now();
      allowance_ +=
          settings_.slow_bytes_per_s * std::chrono::duration<double>(now - read_at_).count();
      allowance_ = std::min(allowance_, settings_.slow_bytes_per_s / 10);
      read_at_ = now;
      most = static_cast<std::size_t>(allowance_);
    }
    while (most > 0) {
      const int got = take(piece, std::min(most, sizeof piece));
      if (got <= 0) break;
      most -= static_cast<std::size_t>(got);
      if (habit_ == Habit::kSlow) allowance_ -= got;
      buffer_.append(piece, static_cast<std::size_t>(got));
      parse();
    }
  }

 private:
  void connect() {
    fd_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(settings_.port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("no connection");
    }
    const int on = 1;
    ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    if (settings_.tls == nullptr) return;
    tls_ = SSL_new(settings_.tls);
    SSL_set_fd(tls_, fd_);
    if (SSL_connect(tls_) != 1) throw std::runtime_error("no TLS");
  }

  void upgrade() {
    const char* const scheme = tls_ != nullptr ? "https" : "http";
    put(
        fmt::format("GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{0}\r\nUpgrade: websocket\r\n"
                    "Connection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: rave.gui.1\r\n"
                    "Origin: {1}://127.0.0.1:{0}\r\nCookie: {2}\r\n\r\n",
                    settings_.port, scheme, settings_.cookie));
    std::string answer;
    while (answer.find("\r\n\r\n") == std::string::npos) {
      char one = 0;
      if (take(&one, 1) <= 0) throw std::runtime_error("not let in: " + answer);
      answer.push_back(one);
    }
    if (!answer.starts_with("HTTP/1.1 101")) throw std::runtime_error("not let in: " + answer);
  }

  int take(char* to, std::size_t most) {
    const int got = tls_ != nullptr ? SSL_read(tls_, to, static_cast<int>(most))
                                    : static_cast<int>(::recv(fd_, to, most, 0));
    if (got > 0) return got;
    if (tls_ != nullptr) {
      const int why = SSL_get_error(tls_, got);
      ERR_clear_error();
      if (why == SSL_ERROR_WANT_READ) return 0;
    } else if (got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      return 0;
    }
    throw std::runtime_error("the server has ended a line");
  }

  void put(std::string_view bytes) {
    const auto size = static_cast<int>(bytes.size());
    const int sent = tls_ != nullptr
                         ? SSL_write(tls_, bytes.data(), size)
                         : static_cast<int>(::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
    if (sent != size) throw std::runtime_error("the server takes nothing");
  }

  /// The mask is zero: it leaves the bytes as they are.
  void send(std::string_view text, int opcode = 1) {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(text.size() >> 8U);
      frame += static_cast<char>(text.size());
    }
    put(frame.append(4, '\0').append(text));
  }

  void parse() {
    std::size_t begin = 0;
    while (true) {
      const std::size_t left = buffer_.size() - begin;
      if (left < 2) break;
      const int opcode = buffer_[begin] & 15;
      std::uint64_t size = static_cast<unsigned char>(buffer_[begin + 1]) & 127U;
      const std::size_t more = size == 126 ? 2U : (size == 127 ? 8U : 0U);
      if (left < 2 + more) break;
      if (more > 0) size = 0;
      for (std::size_t i = 0; i < more; ++i) {
        size = size * 256 + static_cast<unsigned char>(buffer_[begin + 2 + i]);
      }
      if (left < 2 + more + size) break;
      frame(opcode, begin + 2 + more, static_cast<std::size_t>(size));
      begin += 2 + more + static_cast<std::size_t>(size);
    }
    buffer_.erase(0, begin);
  }

  void frame(int opcode, std::size_t begin, std::size_t size) {
    if (opcode == 9) return send(buffer_.substr(begin, size), 10);
    // A frame of reported poses of the moment.
    if (opcode != 2 || size < 48 || buffer_[begin] != 1 || buffer_[begin + 1] != 0) return;
    const std::uint32_t taken = at<std::uint32_t>(buffer_, begin + 44);
    if (taken == 0) throw std::runtime_error("frames do not say when they were taken");
    ages_us.push_back(static_cast<std::int32_t>(now_us() - taken));
    arrivals_s.push_back(std::chrono::duration<double>(Clock::now().time_since_epoch()).count());
    send(fmt::format(R"({{"type":"ack","sequence":{}}})", at<std::uint32_t>(buffer_, begin + 4)));
  }

  const Settings& settings_;
  Habit habit_;
  int fd_ = -1;
  SSL* tls_ = nullptr;
  std::string buffer_;
  double allowance_ = 0;
  Clock::time_point read_at_;
};

using Lines = std::vector<std::unique_ptr<Line>>;

/// Serves the lines for so long. `stall`: those of that habit are not read any more.
void spin(const Lines& lines, double seconds, bool stall) {
  const int poll = ::epoll_create1(EPOLL_CLOEXEC);
  for (const auto& line : lines) {
    if (line->habit() == Habit::kSlow || (stall && line->habit() == Habit::kStalled)) continue;
    epoll_event event{EPOLLIN, {line.get()}};
    ::epoll_ctl(poll, EPOLL_CTL_ADD, line->fd(), &event);
  }
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Clock::now() < end) {
    epoll_event events[64];
    const int ready = ::epoll_wait(poll, events, 64, 5);
    for (int i = 0; i < ready; ++i) static_cast<Line*>(events[i].data.ptr)->read();
    for (const auto& line : lines) {
      if (line->habit() == Habit::kSlow) line->read();
    }
  }
  ::close(poll);
}

double quantile_ms(std::vector<std::int32_t>& ages_us, double share) {
  if (ages_us.empty()) return -1;
  const auto place = static_cast<std::size_t>(share * static_cast<double>(ages_us.size() - 1));
  std::ranges::nth_element(ages_us, ages_us.begin() + static_cast<std::ptrdiff_t>(place));
  return ages_us[place] / 1000.0;
}

std::string result_of(const Lines& lines, Habit habit, double seconds) {
  std::vector<std::int32_t> ages;
  double longest_gap_s = 0;
  std::size_t count = 0;
  for (const auto& line : lines) {
    if (line->habit() != habit) continue;
    ++count;
    ages.insert(ages.end(), line->ages_us.begin(), line->ages_us.end());
    for (std::size_t i = 1; i < line->arrivals_s.size(); ++i) {
      longest_gap_s = std::max(longest_gap_s, line->arrivals_s[i] - line->arrivals_s[i - 1]);
    }
  }
  if (count == 0) return "null";
  const double frames = static_cast<double>(ages.size()) / static_cast<double>(count) / seconds;
  const double median_ms = quantile_ms(ages, 0.5);
  const double p99_ms = quantile_ms(ages, 0.99);
  return fmt::format(
      R"({{"clients":{},"frames_per_client_s":{:.1f},"age_ms_median":{:.1f},"age_ms_p99":{:.1f},)"
      R"("age_ms_most":{:.1f},"gap_ms_most":{:.0f}}})",
      count, frames, median_ms, p99_ms, quantile_ms(ages, 1), 1000 * longest_gap_s);
}

SSL_CTX* tls_of(const std::string& authority) {
  SSL_CTX* const context = SSL_CTX_new(TLS_client_method());
  if (SSL_CTX_load_verify_file(context, authority.c_str()) != 1) {
    throw std::runtime_error("no certificate of an authority in " + authority);
  }
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  return context;
}

void run(std::span<char* const> words) {
  Settings settings;
  settings.port = static_cast<std::uint16_t>(std::atoi(words[0]));
  settings.cookie = words[1];
  if (std::string_view(words[2]) != "-") settings.tls = tls_of(words[2]);
  const int clients = std::atoi(words[3]);
  const int stalled = std::atoi(words[4]);
  const int slow = std::atoi(words[5]);
  settings.slow_bytes_per_s = std::atof(words[6]);
  settings.hz = std::atof(words[7]);
  const double warm_s = std::atof(words[8]);
  const double seconds = std::atof(words[9]);
  Lines lines;
  for (int i = 0; i < clients; ++i) {
    const Habit habit =
        i < stalled ? Habit::kStalled : (i < stalled + slow ? Habit::kSlow : Habit::kPrompt);
    lines.push_back(std::make_unique<Line>(settings, habit));
  }
  spin(lines, warm_s, false);
  for (const auto& line : lines) {
    line->ages_us.clear();
    line->arrivals_s.clear();
  }
  std::puts("begin");
  std::fflush(stdout);
  spin(lines, seconds, true);
  std::puts(fmt::format(R"({{"prompt":{},"slow":{}}})", result_of(lines, Habit::kPrompt, seconds),
                        result_of(lines, Habit::kSlow, seconds))
                .c_str());
  std::fflush(stdout);
  // Lines stay open until what they cost is measured.
  static_cast<void>(std::getchar());
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  if (argc != 11) {
    std::fputs(
        "expected PORT COOKIE AUTHORITY|- CLIENTS STALLED SLOW SLOW_BYTES_PER_S HZ WARM_S SPAN_S\n",
        stderr);
    return 2;
  }
  try {
    run(std::span(argv + 1, 10));
  } catch (const std::exception& error) {
    std::fputs(fmt::format("{}\n", error.what()).c_str(), stderr);
    return 1;
  }
  return 0;
}
