// How large a message may be (SPEC 3, 7). All of these hold before anything is parsed or allocated.
#pragma once

#include <QtGlobal>

namespace lampblack::protocol
{

struct Limits
{
    qint64 headerBytes = 65536;
    qint64 planes = 4;             ///< frames after the header
    qint64 planeBytes = 268435456; ///< of each of them; also for ZMQ_MAXMSGSIZE
    qint64 depth = 32;             ///< objects and arrays within one another, the header included
    qint64 side = 16384;           ///< longer side of a plane, pixels
    qint64 pixels = 40000000;      ///< of a plane
};

} // namespace lampblack::protocol
