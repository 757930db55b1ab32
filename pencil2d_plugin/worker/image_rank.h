// Which of two images of the worker is newer (SPEC 6).
#pragma once

#include <QtGlobal>

#include <optional>
#include <tuple>

namespace lampblack
{

/// Images are ordered by request, then by drawing, then by scene revision, then by pass.
struct ImageRank
{
    quint64 request = 0;
    quint64 drawing = 0; ///< ShownFrame::drawing
    quint64 revision = 0;
    quint64 pass = 0;
};

inline bool operator<(const ImageRank& a, const ImageRank& b)
{
    return std::tie(a.request, a.drawing, a.revision, a.pass) <
           std::tie(b.request, b.drawing, b.revision, b.pass);
}

} // namespace lampblack
