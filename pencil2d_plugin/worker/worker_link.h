// The socket to the worker, in a thread of its own.
#pragma once

#include "worker/inbox.h"
#include "worker/outbox.h"

#include <QMutex>
#include <QThread>

#include <vector>

#include <zmq.hpp>

namespace lampblack
{

/// One connection, from its making to its end; for another worker make another. Encoding, decoding and
/// copying of pixels happen in its thread; the functions are for the thread that made it, and never wait.
class WorkerLink : public QThread
{
    Q_OBJECT

public:
    explicit WorkerLink(const QString& endpoint, QObject* parent = nullptr);
    /// Waits for the thread, a few milliseconds; retire() does not.
    ~WorkerLink() override;

    /// False if so much waits that the worker must be reading nothing.
    bool send(const Outgoing& outgoing);
    QVector<Incoming> take();

    /// End the thread, say nothing more, and go when it has ended.
    void retire();

Q_SIGNALS:
    void arrived(); ///< there is something to take(); said once until it is taken
    void silent();  ///< nothing can be sent, or ticks were missed (SPEC 5); the thread has ended

private:
    void run() override;
    void converse(zmq::socket_t& socket, zmq::socket_t& wake);
    bool drain(zmq::socket_t& socket); ///< false if more may be waiting
    void receive(const std::vector<zmq::message_t>& frames);
    void deliver(const Incoming& incoming);
    void flush(zmq::socket_t& socket);
    void wakeUp();
    bool inboxIsFull();
    bool outboxIsEmpty();

    const QByteArray mEndpoint;
    zmq::context_t mContext{1};
    zmq::socket_t mWake; ///< the maker's end of what wakes the thread

    QMutex mMutex; ///< of the next three
    Outbox mOutbox;
    Inbox mInbox;
    bool mClosing = false;

    // Of the thread alone.
    qint64 mPatienceMs = 0; ///< silence that is borne
    qint64 mHeardMs = 0;    ///< when a tick came last, by a clock that only rises
    int mRefused = 0;
    bool mToldTooLong = false; ///< once is enough: a dragged light would tell of it without end
};

} // namespace lampblack
