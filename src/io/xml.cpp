// Reads the part of XML 1.0 (W3C, fifth edition) that ASTM E2807 and 3MF use.
#include "io/xml.h"

#include <algorithm>

#include "io/text.h"
#include "relievo/core/text.h"

namespace relievo::io {
namespace {

constexpr bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view without_space(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

class XmlParser {
 public:
  XmlParser(std::string_view text, const Source& source)
      : text_(text), source_(source), at_(byte_order_mark_size(text)) {}

  Result<XmlElements> parse() {
    while (at_ < text_.size()) {
      RELIEVO_CHECK(take_text());
      if (at_ < text_.size()) RELIEVO_CHECK(take_markup());
    }
    if (!open_.empty())
      return error(cat("expected the end of the element ", name_of(open_.back()), ", found the end"));
    if (elements_.empty()) return error("expected an element, found none");
    return std::move(elements_);
  }

 private:
  std::unexpected<Error> error(std::string expected) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    return source_.error(cat("line ", line, " of the XML"), std::move(expected));
  }

  std::string name_of(std::size_t element) const { return in_quotes(elements_[element].name); }

  void keep(std::string_view text) {
    if (!open_.empty() && elements_[open_.back()].text.empty()) elements_[open_.back()].text = text;
  }

  Result<void> take_text() {
    const std::size_t end = std::min(text_.find('<', at_), text_.size());
    const std::string_view text = without_space(text_.substr(at_, end - at_));
    // Some writers append zero bytes to the XML.
    if (!text.empty() && open_.empty() && text.find_first_not_of('\0') != std::string_view::npos)
      return error(cat("expected an element, found ", in_quotes(text)));
    keep(text);
    at_ = end;
    return {};
  }

  Result<void> take_markup() {
    const std::string_view rest = text_.substr(at_);
    constexpr std::string_view cdata = "<![CDATA[";
    if (rest.starts_with(cdata)) {
      RELIEVO_TRY(const std::string_view all, skip_to("]]>"));
      keep(all.substr(cdata.size()));
      return {};
    }
    if (rest.starts_with("<?")) return skip("?>");
    if (rest.starts_with("<!--")) return skip("-->");
    if (rest.starts_with("<!DOCTYPE") && elements_.empty()) return skip_document_type();
    if (rest.starts_with("<!")) return error("expected an element, found a document type");
    return rest.starts_with("</") ? take_end_tag() : take_start_tag();
  }

  // Skips a document type with the declarations in it, as programs for drawings write it.
  Result<void> skip_document_type() {
    const std::size_t next = text_.find_first_of("[>", at_);
    if (next != std::string_view::npos && text_[next] == '[') RELIEVO_CHECK(skip("]"));
    return skip(">");
  }

  Result<void> skip(std::string_view mark) {
    RELIEVO_CHECK(skip_to(mark));
    return {};
  }

  // Moves to the end of the next `mark`. Returns the text before the mark.
  Result<std::string_view> skip_to(std::string_view mark) {
    const std::size_t end = text_.find(mark, at_);
    if (end == std::string_view::npos) return error(cat("expected ", mark, ", found the end"));
    const std::string_view skipped = text_.substr(at_, end - at_);
    at_ = end + mark.size();
    return skipped;
  }

  Result<void> take_end_tag() {
    const std::string_view name = without_space(text_.substr(at_ + 2, text_.find('>', at_) - at_ - 2));
    if (open_.empty() || name != elements_[open_.back()].name)
      return error(cat("expected the end of ", open_.empty() ? "the document" : name_of(open_.back()),
                       ", found that of ", in_quotes(name)));
    RELIEVO_CHECK(skip_to(">"));
    elements_[open_.back()].end = elements_.size();
    open_.pop_back();
    return {};
  }

  // Returns the position of the '>' that ends the tag, ignoring those in quotation marks.
  std::size_t end_of_tag() const {
    for (std::size_t i = at_; i < text_.size(); ++i) {
      if (text_[i] == '>') return i;
      if (text_[i] == '"' || text_[i] == '\'') i = text_.find(text_[i], i + 1);
      if (i == std::string_view::npos) break;
    }
    return std::string_view::npos;
  }

  Result<void> take_start_tag() {
    const std::size_t end = end_of_tag();
    if (end == std::string_view::npos) return error("expected the end of a tag, found the end");
    if (open_.empty() && !elements_.empty())
      return error("expected one root element, found " + in_quotes(text_.substr(at_, end + 1 - at_)) +
                   " after it");
    std::string_view tag = text_.substr(at_ + 1, end - at_ - 1);
    const bool is_closed = tag.ends_with('/');
    if (is_closed) tag.remove_suffix(1);
    const std::size_t name = std::min(tag.find_first_of(" \t\r\n"), tag.size());
    if (name == 0) return error("expected the name of an element, found none");
    elements_.push_back({tag.substr(0, name), tag.substr(name), {}, elements_.size() + 1});
    if (!is_closed) open_.push_back(elements_.size() - 1);
    at_ = end + 1;
    return {};
  }

  std::string_view text_;
  const Source& source_;
  std::size_t at_;
  XmlElements elements_;
  std::vector<std::size_t> open_;
};

}  // namespace

std::string_view XmlElement::attribute(std::string_view wanted) const {
  std::string_view rest = attributes;
  for (std::size_t equals = rest.find('='); equals != std::string_view::npos; equals = rest.find('=')) {
    const std::string_view name_here = without_space(rest.substr(0, equals));
    const std::size_t open = rest.find_first_of("\"'", equals);
    if (open == std::string_view::npos) break;
    const std::size_t close = rest.find(rest[open], open + 1);
    if (close == std::string_view::npos) break;
    if (name_here == wanted) return rest.substr(open + 1, close - open - 1);
    rest.remove_prefix(close + 1);
  }
  return {};
}

Result<XmlElements> parse_xml(std::string_view text, const Source& source) {
  return XmlParser(text, source).parse();
}

std::size_t find_child(const XmlElements& elements, std::size_t parent, std::string_view name) {
  for (std::size_t i = parent + 1; i < elements[parent].end; i = elements[i].end)
    if (elements[i].name == name) return i;
  return 0;
}

}  // namespace relievo::io
