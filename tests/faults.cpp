#include "faults.h"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <vector>

namespace bookspin {
namespace {

#if defined(__x86_64__)
constexpr std::array argument_registers{REG_RDI, REG_RSI, REG_RDX, REG_R10, REG_R8};
long argument(const ucontext_t& context, std::size_t i) {
  return context.uc_mcontext.gregs[argument_registers[i]];
}
void set_result(ucontext_t& context, long result) {
  context.uc_mcontext.gregs[REG_RAX] = result;
}
constexpr bool known_machine = true;
#elif defined(__aarch64__)
long argument(const ucontext_t& context, std::size_t i) {
  return static_cast<long>(context.uc_mcontext.regs[i]);
}
void set_result(ucontext_t& context, long result) {
  context.uc_mcontext.regs[0] = static_cast<unsigned long long>(result);
}
constexpr bool known_machine = true;
#else
long argument(const ucontext_t&, std::size_t) {
  return 0;
}
void set_result(ucontext_t&, long) {}
constexpr bool known_machine = false;
#endif

constexpr long cookie = 0x600d;  // as a sixth argument, which none of these calls has: the handler's own

const std::vector<unsigned> watched {
  SYS_openat, SYS_close, SYS_read, SYS_pread64, SYS_readv, SYS_write, SYS_pwrite64, SYS_writev, SYS_fsync, SYS_fstat,
      SYS_statx, SYS_ftruncate, SYS_flock, SYS_getdents64, SYS_fdatasync, SYS_newfstatat, SYS_unlinkat, SYS_linkat,
      SYS_mkdirat, SYS_renameat2, SYS_faccessat,
#if defined(__x86_64__)
      SYS_open, SYS_creat, SYS_rename, SYS_link, SYS_unlink, SYS_mkdir, SYS_stat, SYS_lstat, SYS_access, SYS_rmdir,
      SYS_renameat,
#endif
};

struct Shared {
  std::atomic<int> calls;
  std::atomic<int> exit_code;
  std::array<char, 512> message;
};

Shared* shared = nullptr;
Experiment current;

// The sanitizer for undefined behavior writes to one, to learn from the error whether it may read an address.
bool is_pipe(long descriptor) {
  struct stat found {};
  return syscall(SYS_fstat, descriptor, &found, 0, 0, 0, cookie) == 0 && S_ISFIFO(found.st_mode);
}

void on_call(int, siginfo_t* info, void* raw_context) {
  const int errno_before = errno;
  auto& context = *static_cast<ucontext_t*>(raw_context);
  const long call = info->si_syscall;
  std::array<long, 5> a{};
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = argument(context, i);
  const bool no_file = (call == SYS_write || call == SYS_close) && is_pipe(a[0]);
  const int number = no_file ? 0 : ++shared->calls;
  const bool here = number == current.number && !no_file;
  if (here && current.fault == Fault::kills) raise(SIGKILL);
  const bool later = number > current.number;
  if ((here && current.fault == Fault::fails) || ((here || later) && current.fault == Fault::keeps_failing)) {
    if (call == SYS_close) syscall(call, a[0], 0, 0, 0, 0, cookie);  // Linux closes even when it says that it failed
    set_result(context, -current.error);
  } else {
    if (here && current.fault == Fault::cut_short && (call == SYS_write || call == SYS_pwrite64)) a[2] = (a[2] + 1) / 2;
    const long result = syscall(call, a[0], a[1], a[2], a[3], a[4], cookie);
    set_result(context, result == -1 ? -errno : result);
  }
  errno = errno_before;
}

bool arm() {
  std::vector<sock_filter> program{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args) + 5 * sizeof(std::uint64_t)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, cookie, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
  };
  for (const unsigned call : watched) {
    program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, call, 0, 1));
    program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  struct sigaction action {};
  action.sa_sigaction = on_call;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGSYS, &action, nullptr);
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

}  // namespace

bool can_inject_faults() {
  return known_machine && attempt({}, [] { close(-1); }).calls > 0;
}

std::filesystem::path folder_in_memory() {
  const std::filesystem::path shm = "/dev/shm";
  return std::filesystem::is_directory(shm) ? shm : std::filesystem::temp_directory_path();
}

Outcome attempt(const Experiment& experiment, const std::function<void()>& work) {
  void* const memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  shared = static_cast<Shared*>(memory);
  current = experiment;
  shared->exit_code = -1;  // until the child says otherwise: a sanitizer that gives up may exit with 0
  const pid_t child = fork();
  if (child == 0) {
    if (!arm()) _exit(0);
    try {
      work();
      shared->exit_code = 0;
    } catch (const std::exception& error) {
      std::strncpy(shared->message.data(), error.what(), shared->message.size() - 1);
      shared->exit_code = 1;
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.killed = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  if (WIFEXITED(status)) outcome.exit_code = shared->exit_code;
  outcome.message = shared->message.data();
  outcome.calls = shared->calls;
  munmap(memory, sizeof(Shared));
  return outcome;
}

}  // namespace bookspin
