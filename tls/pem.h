#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

/// Small files that people name in settings, of secrets and certificates. What cannot be used is
/// told in words that name the setting, the file, and what is wrong with it. Thread-safe.
namespace choreo {

/// Throws Error(kInvalidArgument, field) where nothing is there, and for what is no regular file:
/// to read a FIFO or a device could take for ever. Links are followed.
void RequireRegularFile(const std::string& field, const std::filesystem::path& path);

/// Its bytes. Throws as RequireRegularFile, and so where it may not be read or has more than `most`
/// bytes, of which it reads none.
std::string ReadSmallFile(const std::string& field, const std::filesystem::path& path, size_t most);

/// A PEM file of certificates, one at least. Throws as ReadSmallFile.
std::string ReadCertificates(const std::string& field, const std::filesystem::path& path);

struct KeyPair {
  std::string certificates, key;  ///< PEM
};

/// A chain of certificates and the private key of its first, which needs no passphrase. Throws as
/// ReadCertificates, with the field whose file is at fault.
KeyPair ReadKeyPair(const std::string& certificate_field,
                    const std::filesystem::path& certificate_path, const std::string& key_field,
                    const std::filesystem::path& key_path);

}  // namespace choreo
