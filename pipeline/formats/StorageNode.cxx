// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/StorageNode.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "core/ToInt.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace novelview
{
namespace
{
using Kind = StorageNode::Kind;

bool IsDigit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** Whether a word begins like a number: 1, -1, .5, -.Inf */
bool BeginsLikeNumber(const std::string& word)
{
  const std::size_t first = word[0] == '-' || word[0] == '+' ? 1 : 0;
  const auto at = [&word](std::size_t i) { return i < word.size() ? word[i] : '\0'; };
  return IsDigit(at(first)) ||
    (at(first) == '.' && std::isalnum(static_cast<unsigned char>(at(first + 1))) != 0);
}

bool ParseStorageNumber(const std::string& word, double& number)
{
  if (word.empty() || !BeginsLikeNumber(word))
  {
    return false;
  }
  const std::string unsignedWord = LowerCase(word.substr(word[0] == '-' || word[0] == '+' ? 1 : 0));
  if (unsignedWord == ".inf" || unsignedWord == ".nan")
  {
    const double value = unsignedWord == ".inf" ? std::numeric_limits<double>::infinity()
                                                : std::numeric_limits<double>::quiet_NaN();
    number = word[0] == '-' ? -value : value;
    return true;
  }
  const char* const begin = word.data() + (word[0] == '+' ? 1 : 0);
  const char* const end = word.data() + word.size();
  const auto [stop, failure] = std::from_chars(begin, end, number);
  if (failure == std::errc::result_out_of_range)
  {
    number = std::strtod(begin, nullptr); // infinity, or 0
  }
  return stop == end && failure != std::errc::invalid_argument;
}

/** Appends the numbers of a value: one, a list's, or those of a text with blanks or commas between. */
void AppendNumbers(const StorageNode& node, const std::string& where, std::vector<double>& numbers)
{
  if (node.What == Kind::Number)
  {
    numbers.push_back(node.Number);
    return;
  }
  if (node.IsList())
  {
    for (const StorageNode& item : node.Items)
    {
      AppendNumbers(item, where, numbers);
    }
    return;
  }
  if (!node.IsText())
  {
    throw Error(where, "is not a list of numbers", node.IsNone() ? "nothing" : "a map", "numbers");
  }
  std::string text = node.Text;
  std::replace(text.begin(), text.end(), ',', ' ');
  for (const std::string& word : Words(text))
  {
    double number = 0;
    if (!ParseStorageNumber(word, number))
    {
      throw Error(where, "is not a number", "'" + word + "'", "a number");
    }
    numbers.push_back(number);
  }
}

/** A number as OpenCV holds it in a matrix's elements of this type. */
double AsElement(double number, char type)
{
  struct IntegerType
  {
    char Letter;
    double Min;
    double Max;
  };
  constexpr std::array<IntegerType, 5> Integers{ { { 'u', 0, 255 }, { 'c', -128, 127 },
    { 'w', 0, 65535 }, { 's', -32768, 32767 }, { 'i', -2147483648., 2147483647. } } };
  for (const IntegerType& integer : Integers)
  {
    if (integer.Letter == type)
    {
      return ClampedNumber(std::rint(number), integer.Min, integer.Max);
    }
  }
  return type == 'd' ? number : static_cast<double>(static_cast<float>(number));
}

/** The number of values that the "dt" of a matrix gives one element, "d" or "3f"; and their type. */
int ChannelsOf(const StorageNode& matrix, const std::string& where, char& type)
{
  const StorageNode& dt = matrix["dt"];
  int channels = 1;
  const std::size_t digits = dt.Text.empty() ? 0 : dt.Text.size() - 1;
  type = dt.Text.empty() ? '\0' : dt.Text.back();
  if (std::string("ucwsifdh").find(type) == std::string::npos || type == '\0' ||
    (digits > 0 && !ParseNumber(dt.Text.substr(0, digits), channels)) || channels < 1)
  {
    throw Error(
      where, "matrix has no \"dt\" that is known", dt.IsNone() ? "none" : dt.Text, "d, f, i, ..");
  }
  return channels;
}

/** The stated number of elements of a matrix: rows x cols, or the product of its "sizes". */
double CountOf(const StorageNode& matrix, const std::string& where)
{
  double count = 1;
  if (!matrix["sizes"].IsNone())
  {
    for (const double size : matrix["sizes"].Numbers(where + ", sizes"))
    {
      count *= size;
    }
    return count;
  }
  for (const char* key : { "rows", "cols" })
  {
    if (matrix[key].What != Kind::Number)
    {
      throw Error(where, std::string("matrix has no \"") + key + "\"");
    }
    count *= matrix[key].Number;
  }
  return count;
}

std::vector<double> MatrixNumbers(const StorageNode& matrix, const std::string& where)
{
  char type = 'd';
  const double expected = ChannelsOf(matrix, where, type) * CountOf(matrix, where);
  std::vector<double> numbers;
  if (!matrix["data"].IsNone())
  {
    AppendNumbers(matrix["data"], where, numbers);
  }
  if (static_cast<double>(numbers.size()) != expected)
  {
    throw Error(where, "matrix does not have its stated size",
      std::to_string(numbers.size()) + " numbers", NumberText(expected));
  }
  for (double& number : numbers)
  {
    number = AsElement(number, type);
  }
  return numbers;
}
}

const StorageNode& StorageNode::operator[](const std::string& key) const
{
  static const StorageNode nothing;
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&key](const auto& entry) { return entry.Key == key; });
  return found == this->Entries.end() ? nothing : found->Value;
}

std::vector<double> StorageNode::Numbers(const std::string& where) const
{
  if (this->What == Kind::Map)
  {
    return MatrixNumbers(*this, where);
  }
  std::vector<double> numbers;
  if (!this->IsNone())
  {
    AppendNumbers(*this, where, numbers);
  }
  return numbers;
}

StorageNode ScalarNode(const std::string& word)
{
  StorageNode node;
  node.Text = word;
  node.What = ParseStorageNumber(word, node.Number) ? Kind::Number : Kind::Text;
  return node;
}
}
