// SPDX-License-Identifier: GPL-3.0-or-later
/** The values of a file of OpenCV's cv::FileStorage. */
#ifndef novelview_StorageNode_h
#define novelview_StorageNode_h

#include <string>
#include <vector>

namespace novelview
{
/** Maps and lists may be nested so deep. */
constexpr int MaxStorageNesting = 32;

struct StorageEntry;

/** A value of such a file. */
struct StorageNode
{
  enum class Kind
  {
    None, ///< nothing, or no such key
    Number,
    Text,
    List,
    Map
  };

  Kind What = Kind::None;
  double Number = 0;
  std::string Text;                  ///< of a number: as it is written
  std::vector<StorageNode> Items;    ///< of a list
  std::vector<StorageEntry> Entries; ///< of a map

  bool IsNone() const { return this->What == Kind::None; }
  bool IsText() const { return this->What == Kind::Text; }
  bool IsList() const { return this->What == Kind::List; }

  /** The value of a map's key; None when there is none. */
  const StorageNode& operator[](const std::string& key) const;

  /**
   * The numbers of a list or of a matrix, row by row; none of None. Throws Error, naming `where`, when
   * it is something else, or the matrix does not have its stated size.
   */
  std::vector<double> Numbers(const std::string& where) const;
};

/** A key of a map and its value. */
struct StorageEntry
{
  std::string Key;
  StorageNode Value;
};

/** A number or a text that is not in quotes, as OpenCV distinguishes them. */
StorageNode ScalarNode(const std::string& word);
}

#endif
