// SPDX-License-Identifier: GPL-3.0-or-later
/** Arrays of NumPy from .npy and .npz files. */
#ifndef novelview_NumpyArrays_h
#define novelview_NumpyArrays_h

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace novelview
{
/** Numbers in rows, whatever their type and order in the file. */
struct NumpyArray
{
  std::vector<std::size_t> Shape;
  std::vector<double> Values;
};

/**
 * An array of floats or integers of 8 to 64 bits. Throws Error, naming `where`, when the bytes are no
 * such array or its values are not all there.
 */
NumpyArray ParseNpy(std::string_view bytes, const std::string& where);

/**
 * The arrays of a .npz file by their names; arrays of other things than numbers are left out. Stored and
 * deflated members of up to 64 MiB are read. Throws Error when the file is damaged.
 */
std::map<std::string, NumpyArray> ReadNpz(const std::filesystem::path& file);

/** The bytes of a .npz file with these arrays as 64-bit floats, stored. */
std::string ComposeNpz(const std::map<std::string, NumpyArray>& arrays);
}

#endif
