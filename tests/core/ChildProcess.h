// SPDX-License-Identifier: BSD-3-Clause
// Runs work in a child process: as another user, on a full disk, or killed at any of its system calls.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sched.h>
#include <set>
#include <string>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cactus_testing
{

/// Returns the result of `work` in a child process, or how the child died.
inline std::string inChild(const std::function<std::string()>& work)
{
  int ends[2];
  if (::pipe(ends) != 0)
  {
    return "no pipe";
  }
  const pid_t child = ::fork();
  if (child == 0)
  {
    const std::string text = work();
    const ssize_t written = ::write(ends[1], text.data(), text.size());
    ::_exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  ::close(ends[1]);
  std::string text;
  char piece[4096];
  for (ssize_t size = 0; (size = ::read(ends[0], piece, sizeof(piece))) > 0;)
  {
    text.append(piece, static_cast<std::size_t>(size));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  return status == 0 ? text : text + " (the child ended with status " + std::to_string(status) + ")";
}

/// For a child: continues as a user with limited permissions. Root may write everywhere.
inline bool becomeOrdinaryUser()
{
  constexpr uid_t nobody = 65534;
  return ::geteuid() != 0 || (::setgid(nobody) == 0 && ::setuid(nobody) == 0);
}

/// For a child: mounts a file system of so many bytes on a folder; only the child sees it, and it disappears with it.
inline bool mountSmallDisk(const std::filesystem::path& folder, std::size_t bytes)
{
  const uid_t user = ::geteuid();
  if (::unshare(user == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER) != 0)
  {
    return false;
  }
  if (user != 0)
  {
    std::ofstream("/proc/self/uid_map") << user << ' ' << user << " 1\n";
  }
  return ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", folder.c_str(), "tmpfs", 0, ("size=" + std::to_string(bytes)).c_str()) == 0;
}

enum class Fate
{
  killed,
  finished,
  untraceable ///< this machine does not permit tracing of processes
};

/// Runs `work` in a child that is killed (SIGKILL) just before its `call`-th system call that changes files.
inline Fate killedAtCall(int call, const std::function<void()>& work)
{
  static const std::set<unsigned long long> changes{
    __NR_openat, __NR_mkdirat, __NR_unlinkat, __NR_renameat2, __NR_write, __NR_fsync, __NR_syncfs, __NR_flock,
#ifdef __NR_mkdir
    __NR_mkdir, __NR_rmdir, __NR_unlink, __NR_rename
#else
    __NR_renameat
#endif
  };
  const pid_t child = ::fork();
  if (child == 0)
  {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0)
    {
      ::_exit(77);
    }
    ::raise(SIGSTOP);
    work();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (!WIFSTOPPED(status))
  {
    return Fate::untraceable;
  }
  ::ptrace(PTRACE_SETOPTIONS, child, nullptr, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
  int signal = 0;
  for (int calls = 0;;)
  {
    ::ptrace(PTRACE_SYSCALL, child, nullptr, signal);
    ::waitpid(child, &status, 0);
    if (!WIFSTOPPED(status))
    {
      return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? Fate::finished : Fate::untraceable;
    }
    signal = WSTOPSIG(status) == (SIGTRAP | 0x80) ? 0 : WSTOPSIG(status);
    if (signal != 0)
    {
      continue;
    }
    __ptrace_syscall_info info{};
    if (::ptrace(static_cast<__ptrace_request>(PTRACE_GET_SYSCALL_INFO), child, sizeof(info), &info) <= 0)
    {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return Fate::untraceable;
    }
    if (info.op == PTRACE_SYSCALL_INFO_ENTRY && changes.count(info.entry.nr) > 0 &&
        (info.entry.nr != __NR_openat || (info.entry.args[2] & O_CREAT) != 0) && ++calls == call)
    {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return Fate::killed;
    }
  }
}

} // namespace cactus_testing
