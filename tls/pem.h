#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

/// Reads small files of secrets and certificates that settings name. Errors name the setting, the
/// file and the problem. Thread-safe.
namespace choreo {

/// Throws Error(kInvalidArgument, field) if nothing is there, or it is not a regular file: reading
/// a FIFO or a device could block for ever. Follows links.
void RequireRegularFile(const std::string& field, const std::filesystem::path& path);

/// The file's bytes. Throws like RequireRegularFile, and if the file is unreadable or longer than
/// `most` bytes, without reading it.
std::string ReadSmallFile(const std::string& field, const std::filesystem::path& path, size_t most);

/// A PEM file with at least one certificate. Throws like ReadSmallFile.
std::string ReadCertificates(const std::string& field, const std::filesystem::path& path);

/// The earliest expiry of these PEM certificates, seconds since 1970: a chain ends with its first.
int64_t ExpiryOf(const std::string& chain);
/// The latest one: authorities stand for each other.
int64_t LatestExpiryOf(const std::string& authorities);

struct KeyPair {
  std::string certificates, key;  ///< PEM
};

/// A chain of certificates and the private key of its first, without a passphrase. Throws like
/// ReadCertificates, with the field of the faulty file.
KeyPair ReadKeyPair(const std::string& certificate_field,
                    const std::filesystem::path& certificate_path, const std::string& key_field,
                    const std::filesystem::path& key_path);

}  // namespace choreo
