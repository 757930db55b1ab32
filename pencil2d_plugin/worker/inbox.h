// What came from the worker and was not looked at yet.
#pragma once

#include "protocol/messages.h"

#include <QImage>
#include <QVector>

namespace lampblack
{

/// A message of the worker's; `picture` came with an image.
struct Incoming
{
    protocol::Message message;
    QImage picture; ///< Format_RGBA8888_Premultiplied or null
};

/// Messages in their order; of images, of ticks and of each job's progress only the newest, so that a client
/// that is busy finds little to do.
class Inbox
{
public:
    void push(const Incoming& incoming);
    QVector<Incoming> take();
    bool isEmpty() const { return mWaiting.isEmpty(); }
    /// So much waits that the socket should be left alone for now.
    bool isFull() const { return mWaiting.size() >= 1000; }

private:
    QVector<Incoming> mWaiting;
};

} // namespace lampblack
