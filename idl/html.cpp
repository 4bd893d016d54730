#include "idl/html.hpp"

namespace slod {
namespace {

constexpr std::string_view common_style =
    "body { font-family: sans-serif; max-width: 75em; margin: 2em auto; }\n"
    "table { border-collapse: collapse; }\n"
    "th, td { padding: 0.1em 0.6em; text-align: right; }\n"
    "th:first-child, td:first-child { text-align: left; }\n";

} // namespace

std::string html_escaped(std::string_view text)
{
    std::string safe;
    for (const char c : text)
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t')
            safe += c;
    return safe;
}

std::string html_element(std::string_view name, std::string_view content)
{
    std::string text = "<";
    text.append(name).append(">").append(content).append("</").append(name).append(">\n");
    return text;
}

std::string html_paragraph(std::string_view text)
{
    return html_element("p", html_escaped(text));
}

std::string html_picture(const std::string& svg)
{
    const auto begin = svg.find("<svg");
    return begin == std::string::npos ? "" : html_element("div", svg.substr(begin));
}

std::string html_document(std::string_view title, std::string_view style, std::string_view body)
{
    const std::string name = html_escaped(title);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n" +
           html_element("head", "<meta charset=\"utf-8\"/>\n" + html_element("title", name) +
                                    html_element("style", std::string(common_style).append(style))) +
           "<body>\n" + html_element("h1", name).append(body) + "</body>\n</html>\n";
}

} // namespace slod
