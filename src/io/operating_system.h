#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>

/// What systems differ in: operating_system_posix.cpp and operating_system_windows.cpp. Paths are
/// in UTF-8 where the system has no other mind. What fails gives -1 or false, and errno says why.
namespace nade::os {

/// Descriptors of files are for bytes as they are, and not handed on to programs that are started.
[[nodiscard]] int open_to_read(const std::string& path);
/// What is there already and is no file: a pipe, a device.
[[nodiscard]] int open_to_write(const std::string& path);
/// Where something has that name it fails with EEXIST.
[[nodiscard]] int create(const std::string& path, std::filesystem::perms permissions);
/// A file that goes with the program, however that ends, until it is given a name. Fails where the
/// system has no such thing.
[[nodiscard]] int create_nameless(const std::filesystem::path& folder,
                                  std::filesystem::perms permissions);
[[nodiscard]] bool give_name(int nameless, const std::string& path);
/// Second descriptors of the program's own streams.
[[nodiscard]] int standard_input();
[[nodiscard]] int standard_output();
[[nodiscard]] int duplicate(int descriptor);
void close(int descriptor);

/// How many bytes were read, 0 at the end.
[[nodiscard]] std::ptrdiff_t read(int descriptor, void* to, std::size_t room);
/// So that what was written outlives the machine's stopping.
[[nodiscard]] bool sync(int descriptor);
/// The same of the names in a folder. Not every file system can do it.
void sync_folder(const std::filesystem::path& folder);

void set_permissions(int descriptor, std::filesystem::perms permissions);
[[nodiscard]] bool may_write(const std::string& path);
[[nodiscard]] bool may_enter(const std::filesystem::path& folder);

/// A new folder that others may not look into. `pattern` ends in "XXXXXX", for which something new
/// is put.
[[nodiscard]] bool make_own_folder(std::string& pattern);

/// A file that goes with its stream, or with the program however that ends.
struct PassingFile {
  std::FILE* stream = nullptr;  ///< to be written; none where it could not be made
  std::string path;             ///< to be read while the stream is open
};
/// `pattern` as above.
[[nodiscard]] PassingFile make_passing_file(std::string pattern);

/// Of the program that runs; empty where that cannot be told.
[[nodiscard]] std::filesystem::path program_file();
[[nodiscard]] int process_number();

/// Whether a person reads standard error.
[[nodiscard]] bool person_looks();
/// Called once, first: the standard streams take bytes as they are, and a console UTF-8.
void prepare_streams();

}  // namespace nade::os
