#pragma once

#include <string>
#include <string_view>

// Of pages that need no other file and no script, and are well-formed as XML.
namespace slod {

/// The text as the content of an element, whatever is in it.
std::string html_escaped(std::string_view text);

/// `content` is HTML.
std::string html_element(std::string_view name, std::string_view content);

/// Of text.
std::string html_paragraph(std::string_view text);

/// A picture as gnuplot writes it, without what stands before it in a file of its own.
std::string html_picture(const std::string& svg);

/// `title` is text, `style` what the page has beside the style of all pages, `body` HTML without the title.
std::string html_document(std::string_view title, std::string_view style, std::string_view body);

} // namespace slod
