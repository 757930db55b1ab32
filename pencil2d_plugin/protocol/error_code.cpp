#include "protocol/error_code.h"

#include <array>

namespace lampblack::protocol
{

QString name(ErrorCode code)
{
    static constexpr std::array<const char*, 18> Names = {
        "bad_frame_count",     "header_too_large", "plane_too_large", "not_lampblack",
        "version_mismatch",    "bad_json",         "too_deep",        "bad_number",
        "unknown_type",        "wrong_direction",  "bad_field",       "bad_value",
        "bad_scene",           "bad_plane_count",  "bad_plane",       "image_too_large",
        "plane_size_mismatch", "digest_mismatch"};
    return QLatin1String(Names.at(static_cast<std::size_t>(code)));
}

} // namespace lampblack::protocol
