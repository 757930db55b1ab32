// Messages that wait to be sent to the worker.
#pragma once

#include "protocol/messages.h"

#include <QHash>
#include <QImage>
#include <QVector>

#include <list>

namespace lampblack
{

/// A message to the worker; `planes` belong to a put_frame.
struct Outgoing
{
    protocol::Message message;
    QVector<QImage> planes; ///< Format_RGBA8888
};

/// Messages in order, but a newer scene, preview request or drawing of a frame replaces an older one (SPEC
/// 6). Nothing that waits before a hello or render is replaced by something after it.
class Outbox
{
public:
    /// False if too many messages wait that cannot be replaced: the worker has stopped reading.
    bool push(const Outgoing& outgoing);
    bool isEmpty() const { return mWaiting.empty(); }
    Outgoing takeFirst(); ///< must not be empty

private:
    struct Entry
    {
        Outgoing outgoing;
        qint64 key; ///< a newer message with this key replaces it, see replacementKey()
    };
    using Place = std::list<Entry>::iterator;

    std::list<Entry> mWaiting;
    QHash<qint64, Place> mReplaceable;
    int mUnreplaceable = 0;
};

} // namespace lampblack
