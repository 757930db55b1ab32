// What waits to be sent to the worker.
#pragma once

#include "protocol/messages.h"

#include <QHash>
#include <QImage>

#include <list>

namespace lampblack
{

/// A message of ours; `pixels` go with a put_frame.
struct Outgoing
{
    protocol::Message message;
    QImage pixels; ///< Format_RGBA8888 or null
};

/// Messages in their order, but for what a newer one replaces (SPEC 6): a scene, a look, what a frame shows.
/// Nothing is replaced across a hello or render.
class Outbox
{
public:
    /// False if a thousand messages wait that nothing replaces: the worker reads nothing any more.
    bool push(const Outgoing& outgoing);
    bool isEmpty() const { return mWaiting.empty(); }
    Outgoing takeFirst(); ///< only if there is one

private:
    struct Entry
    {
        Outgoing outgoing;
        qint64 key; ///< of what replaces it, see keyOf() in outbox.cpp
    };
    using Place = std::list<Entry>::iterator;

    std::list<Entry> mWaiting;
    QHash<qint64, Place> mReplaceable;
    int mLasting = 0;
};

} // namespace lampblack
