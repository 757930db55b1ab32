// Messages from the worker that wait to be handled.
#pragma once

#include "protocol/messages.h"

#include <QImage>
#include <QVector>

namespace lampblack
{

/// A message of the worker. An image message has a picture.
struct Incoming
{
    protocol::Message message;
    QImage picture; ///< Format_RGBA8888_Premultiplied or null
};

/// Messages in order of arrival. Only the newest image, the newest status and the newest progress of each job
/// are kept, so that little waits for a busy client.
class Inbox
{
public:
    void push(const Incoming& incoming);
    QVector<Incoming> takeAll();
    bool isEmpty() const { return mWaiting.isEmpty(); }
    /// So much waits that nothing more should be read from the socket.
    bool isFull() const { return mWaiting.size() >= 1000; }

private:
    QVector<Incoming> mWaiting;
};

} // namespace lampblack
