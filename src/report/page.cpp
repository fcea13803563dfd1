#include "report/page.h"

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string_view>

#include "report/page_parts.h"
#include "report/page_picture.h"

namespace tyndall {
namespace {

using nlohmann::ordered_json;

/// A name in the template, and what is written in its place.
struct Slot {
  std::string_view name;
  std::string text;
};

std::string_view part(std::string_view name) {
  for (const PagePart& p : page_parts())
    if (p.name == name) return p.text;
  throw std::logic_error("no page part " + std::string(name));
}

std::string joined(std::initializer_list<std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += part(name);
  return text;
}

/// Safe as text and as a quoted attribute.
std::string escape_html(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

/// JSON for a <script>: neither "</script" nor "<!--" can end it or change how it is read, for in JSON a "<" stands in
/// strings only, where its escape means the same. Broken UTF-8 becomes U+FFFD.
std::string embedded_json(const ordered_json& value) {
  const std::string text = value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

std::string_view name_of(PagePicture::Kind kind) { return kind == PagePicture::Kind::samples ? "samples" : "light"; }

std::string embedded_pictures(const std::vector<PagePicture>& pictures) {
  std::string out;
  for (const PagePicture& p : pictures) {
    out += "<script type=\"text/plain\" class=\"picture\" data-group=\"" + escape_html(p.group) + "\" data-name=\"" +
           escape_html(p.name) + "\" data-kind=\"" + std::string(name_of(p.kind)) + "\" data-x=\"" +
           std::to_string(p.image.data.x0) + "\" data-y=\"" + std::to_string(p.image.data.y0) + "\" data-width=\"" +
           std::to_string(p.image.width()) + "\" data-height=\"" + std::to_string(p.image.height()) + "\">" +
           encode_picture(p.image) + "</script>\n";
  }
  return out;
}

/// Every {{name}} of the template replaced once; what is put in is not looked at again.
std::string fill(std::string_view form, std::initializer_list<Slot> slots) {
  std::size_t size = form.size();
  for (const Slot& s : slots) size += s.text.size();
  std::string out;
  out.reserve(size);
  for (;;) {
    const std::size_t begin = form.find("{{"), end = form.find("}}", begin);
    if (end == std::string_view::npos) return out.append(form);
    const std::string_view name = form.substr(begin + 2, end - begin - 2);
    const auto slot = std::find_if(slots.begin(), slots.end(), [name](const Slot& s) { return s.name == name; });
    if (slot == slots.end()) throw std::logic_error("no text for {{" + std::string(name) + "}}");
    out.append(form.substr(0, begin)).append(slot->text);
    form.remove_prefix(end + 2);
  }
}

std::string text_of(const ordered_json& results, const char* key) {
  const auto found = results.find(key);
  return found != results.end() && found->is_string() ? found->get<std::string>() : std::string("?");
}

struct PageText {
  std::string title;
  std::string_view own_script;  ///< the part that lays out this kind of page
  std::string nonce{};          ///< of its script
};

std::string page(const PageText& text, const ordered_json& results, const std::vector<PagePicture>& pictures) {
  const std::string script = joined({"dom.js", "format.js", "pictures.js", "tone.js", "view.js", "viewer.js", "viewer_wipe.js",
                                     "viewer_input.js", "viewer_controls.js", "table.js", "parts.js", "plot_axes.js", "plot.js",
                                     "sheet.js", "facts.js", "theme.js", "live_picture.js", text.own_script});
  return fill(part("page.html"), {{"title", escape_html(text.title)},
                                  {"style", joined({"page.css", "viewer.css", "live.css", "print.css"})},
                                  {"results", embedded_json(results)},
                                  {"pictures", embedded_pictures(pictures)},
                                  {"nonce", text.nonce.empty() ? "" : " nonce=\"" + escape_html(text.nonce) + "\""},
                                  {"script", script}});
}

}  // namespace

std::string compare_page(const ordered_json& results, const std::vector<PagePicture>& pictures) {
  return page({"Tyndall: " + text_of(results, "scene"), "compare.js"}, results, pictures);
}

std::string regress_page(const ordered_json& results, const std::vector<PagePicture>& pictures) {
  return page({"Tyndall: " + text_of(results, "suite"), "regress.js"}, results, pictures);
}

std::string live_page(const ordered_json& start, const std::string& nonce) {
  return page({"Tyndall: " + text_of(start, "title"), "live.js", nonce}, start, {});
}

}  // namespace tyndall
