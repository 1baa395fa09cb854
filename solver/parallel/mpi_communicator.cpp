#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include <mpi.h>
#include <unistd.h>

#include "solver/parallel/launched.hpp"
#include "solver/parallel/processes.hpp"

namespace granvof {
namespace {

// Values that are added up in one order by every process, from what each gave; more are added up by one.
constexpr std::size_t most_values_in_order = 4096;

int count(std::size_t n) {
  if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a message of more than 2 GB");
  return static_cast<int>(n);
}

using Clock = std::chrono::steady_clock;

// How long a wait holds its core. Between processes that have a core each a message takes microseconds, and
// one that is late will be there within a part of a step. With more processes than cores the one that is
// waited for gets none meanwhile.
Clock::duration worth_a_core() {
  MPI_Comm node{};
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  int processes = 1;
  MPI_Comm_size(node, &processes);
  MPI_Comm_free(&node);
  const bool each_has_one = processes <= sysconf(_SC_NPROCESSORS_ONLN);  // of the node, bound to some or not
  return each_has_one ? std::chrono::microseconds(1000) : std::chrono::microseconds(50);
}

class MpiCommunicator final : public Communicator {
 public:
  MpiCommunicator() {
    // Open MPI, with more processes than cores, gives the core away in every test of a request. That is for
    // wait_for() to say: beside other work 4 processes on 2 cores took 28 s so, and 12 s without.
    setenv("OMPI_MCA_mpi_yield_when_idle", "0", 0);
    int given = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS)
      throw std::runtime_error("MPI cannot be started");
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    patience_ = worth_a_core();
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  MpiCommunicator(MpiCommunicator&&) = delete;
  MpiCommunicator& operator=(MpiCommunicator&&) = delete;
  ~MpiCommunicator() override { MPI_Finalize(); }

  int size() const override { return size_; }
  int rank() const override { return rank_; }

  void sum(std::span<double> values) const override {
    combine(values, MPI_SUM, [](double a, double b) { return a + b; });
  }
  void max(std::span<double> values) const override {
    combine(values, MPI_MAX, [](double a, double b) { return std::max(a, b); });
  }

  void trade(const End& below, const End& above) const override {
    constexpr int downwards = 0, upwards = 1;
    const int lower = (rank_ + size_ - 1) % size_, upper = (rank_ + 1) % size_;
    std::array<MPI_Request, 4> requests{};
    int n = 0;
    const auto with = [&](const End& end, int other, int tag_in, int tag_out) {
      if (end.in.empty()) return;
      MPI_Irecv(end.in.data(), count(end.in.size()), MPI_BYTE, other, tag_in, MPI_COMM_WORLD, &requests[n++]);
      MPI_Isend(end.out.data(), count(end.out.size()), MPI_BYTE, other, tag_out, MPI_COMM_WORLD,
                &requests[n++]);
      ++traffic_.messages;
      traffic_.bytes += static_cast<long>(end.out.size());
    };
    with(below, lower, upwards, downwards);
    with(above, upper, downwards, upwards);
    wait_for(std::span(requests).first(static_cast<std::size_t>(n)));
  }

  void gather(std::span<const std::byte> mine, std::span<const std::size_t> sizes, std::span<std::byte> all,
              bool everywhere) const override {
    std::vector<int> counts, begins;
    std::size_t begin = 0;
    for (const std::size_t bytes : sizes) {
      counts.push_back(count(bytes));
      begins.push_back(count(begin));
      begin += bytes;
    }
    complete([&](MPI_Request* request) {
      if (everywhere)
        MPI_Iallgatherv(mine.data(), count(mine.size()), MPI_BYTE, all.data(), counts.data(), begins.data(),
                        MPI_BYTE, MPI_COMM_WORLD, request);
      else
        MPI_Igatherv(mine.data(), count(mine.size()), MPI_BYTE, all.data(), counts.data(), begins.data(),
                     MPI_BYTE, 0, MPI_COMM_WORLD, request);
    });
    meet(mine.size());
  }

  void broadcast(std::span<std::byte> bytes) const override {
    complete([&](MPI_Request* request) {
      MPI_Ibcast(bytes.data(), count(bytes.size()), MPI_BYTE, 0, MPI_COMM_WORLD, request);
    });
    meet(rank_ == 0 ? bytes.size() : 0);
  }

  void abort(int code) const override { MPI_Abort(MPI_COMM_WORLD, code); }
  Traffic traffic() const override { return traffic_; }

 private:
  // MPI leaves open in which order MPI_Allreduce combines, and whether every process gets the same rounding.
  template <typename Two>
  void combine(std::span<double> values, MPI_Op operation, Two&& two) const {
    const int n = count(values.size());
    const auto processes = static_cast<std::size_t>(size_);
    if (values.size() * processes <= most_values_in_order) {
      given_.resize(values.size() * processes);
      complete([&](MPI_Request* request) {
        MPI_Iallgather(values.data(), n, MPI_DOUBLE, given_.data(), n, MPI_DOUBLE, MPI_COMM_WORLD, request);
      });
      for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = given_[i];
        for (std::size_t p = 1; p < processes; ++p) values[i] = two(values[i], given_[p * values.size() + i]);
      }
    } else {
      given_.resize(values.size());
      complete([&](MPI_Request* request) {
        MPI_Ireduce(values.data(), given_.data(), n, MPI_DOUBLE, operation, 0, MPI_COMM_WORLD, request);
      });
      if (rank_ == 0) std::copy(given_.begin(), given_.end(), values.begin());
      complete([&](MPI_Request* request) {
        MPI_Ibcast(values.data(), n, MPI_DOUBLE, 0, MPI_COMM_WORLD, request);
      });
    }
    meet(values.size_bytes());
  }
  // Until they are done. MPI's own waiting never gives its core away.
  void wait_for(std::span<MPI_Request> requests) const {
    constexpr std::chrono::microseconds nap{20};
    const Clock::time_point begin = Clock::now();
    for (;;) {
      int done = 0;
      MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
      if (done != 0) return;
      if (Clock::now() - begin > patience_) std::this_thread::sleep_for(nap);
    }
  }
  // begin(request) begins what is then waited for.
  template <typename Begin>
  void complete(Begin&& begin) const {
    MPI_Request request{};
    begin(&request);
    wait_for({&request, 1});
  }
  void meet(std::size_t bytes) const {
    ++traffic_.meetings;
    traffic_.bytes += static_cast<long>(bytes);
  }

  int size_ = 1, rank_ = 0;
  Clock::duration patience_{};
  mutable std::vector<double> given_;
  mutable Traffic traffic_;
};

}  // namespace

std::unique_ptr<Communicator> launched_processes() {
  if (!has_launcher()) return nullptr;
  auto processes = std::make_unique<MpiCommunicator>();
  if (processes->size() == 1) return nullptr;
  return processes;
}

}  // namespace granvof
