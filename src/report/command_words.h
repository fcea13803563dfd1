/// A command line that was recorded, to be given again with other options.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tyndall {

/// Options are named by all their spellings: {"-o", "--output"}; "--spp 4", "--spp=4" and "-ofile" are understood.
class CommandWords {
 public:
  using Names = std::vector<std::string_view>;

  /// Of what shell_quoted() made of each word.
  explicit CommandWords(std::string_view command);

  /// The value of an option, the last one where it stands several times; nothing where it is not given.
  std::optional<std::string> value(const Names& option) const;
  /// Gives the option, wherever it stands, another value; adds none.
  void change(const Names& option, const std::string& value);
  void drop(const Names& option);
  void add(std::string_view option, const std::string& value);

  /// For a shell.
  std::string str() const;

 private:
  /// The option that begins at a word.
  struct Found;
  std::optional<Found> find(std::size_t word, const Names& option) const;

  std::vector<std::string> words_;
};

}  // namespace tyndall
