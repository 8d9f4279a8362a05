#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

/// Reads small files of secrets and certificates named by settings. Errors name the setting, the
/// file and the problem. Thread-safe.
namespace choreo {

/// Throws Error(kInvalidArgument, field) unless `path` is a regular file, because reading a FIFO or
/// a device could block for ever. Follows links.
void RequireRegularFile(const std::string& field, const std::filesystem::path& path);

/// Returns the file's bytes. Throws what RequireRegularFile throws, also if the file is unreadable
/// or, without reading it, if it is longer than `most` bytes.
std::string ReadSmallFile(const std::string& field, const std::filesystem::path& path, size_t most);

/// Reads a PEM file with at least one certificate. Throws what ReadSmallFile throws.
std::string ReadCertificates(const std::string& field, const std::filesystem::path& path);

/// The earliest expiry of PEM certificates, seconds since 1970: a chain is invalid once one of them
/// expires.
int64_t ExpiryOf(const std::string& chain);
/// The latest expiry: one valid authority is enough.
int64_t LatestExpiryOf(const std::string& authorities);

struct KeyPair {
  std::string certificates, key;  ///< PEM
};

/// Reads a chain of certificates and the private key of its first, which has no passphrase. Throws
/// what ReadCertificates throws, with the field of the faulty file.
KeyPair ReadKeyPair(const std::string& certificate_field,
                    const std::filesystem::path& certificate_path, const std::string& key_field,
                    const std::filesystem::path& key_path);

}  // namespace choreo
