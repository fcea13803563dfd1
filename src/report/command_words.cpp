#include "report/command_words.h"

#include "report/shell_quote.h"

namespace tyndall {
namespace {

/// Quotes of one kind, ', in which all stands for itself, and \ outside of them, which stands for what follows.
std::vector<std::string> words_of(std::string_view command) {
  std::vector<std::string> words;
  std::string word;
  bool begun = false, quoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (c == '\'') {
      quoted = !quoted;
      begun = true;
    } else if (c == ' ' && !quoted) {
      if (begun) words.push_back(std::move(word));
      word.clear();
      begun = false;
    } else {
      word += c == '\\' && !quoted && i + 1 < command.size() ? command[++i] : c;
      begun = true;
    }
  }
  if (begun) words.push_back(std::move(word));
  return words;
}

}  // namespace

struct CommandWords::Found {
  std::string before;  ///< what of the word stands before the value; empty: that is a word of its own
  std::string value;
  std::size_t words;  ///< that the option takes
};

CommandWords::CommandWords(std::string_view command) : words_(words_of(command)) {}

std::optional<CommandWords::Found> CommandWords::find(std::size_t word, const Names& option) const {
  const std::string& text = words_[word];
  for (const std::string_view name : option) {
    if (text == name && word + 1 < words_.size()) return Found{"", words_[word + 1], 2};
    if (!text.starts_with(name)) continue;
    const bool is_long = name.starts_with("--"), assigned = text.size() > name.size() && text[name.size()] == '=';
    if (is_long != assigned || text.size() == name.size()) continue;
    const std::size_t begin = name.size() + (assigned ? 1 : 0);
    return Found{text.substr(0, begin), text.substr(begin), 1};
  }
  return std::nullopt;
}

std::optional<std::string> CommandWords::value(const Names& option) const {
  std::optional<std::string> last;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if (const auto found = find(i, option)) last = found->value;
  }
  return last;
}

void CommandWords::change(const Names& option, const std::string& value) {
  for (std::size_t i = 0; i < words_.size(); ++i) {
    if (const auto found = find(i, option)) words_[i + found->words - 1] = found->before + value;
  }
}

void CommandWords::drop(const Names& option) {
  for (std::size_t i = 0; i < words_.size();) {
    const auto found = find(i, option);
    if (!found) {
      ++i;
      continue;
    }
    const auto begin = words_.begin() + static_cast<std::ptrdiff_t>(i);
    words_.erase(begin, begin + static_cast<std::ptrdiff_t>(found->words));
  }
}

void CommandWords::add(std::string_view option, const std::string& value) {
  words_.emplace_back(option);
  words_.push_back(value);
}

std::string CommandWords::str() const {
  std::string text;
  for (const std::string& word : words_) text += (text.empty() ? "" : " ") + shell_quoted(word);
  return text;
}

}  // namespace tyndall
