// The socket to the worker, in its own thread.
#pragma once

#include "worker/curve_keys.h"
#include "worker/inbox.h"
#include "worker/outbox.h"

#include <QMutex>
#include <QThread>

#include <vector>

#include <zmq.hpp>

namespace lampblack
{

/// One connection to one worker process. Its thread encodes, decodes and copies pixels. The public functions
/// are called from the thread that created it and do not block.
class WorkerLink : public QThread
{
    Q_OBJECT

public:
    /// How a connection ended.
    enum class Loss
    {
        Silent,     ///< nothing can be sent, or status messages are missing (SPEC 5)
        NotReached, ///< nobody has answered
        Refused     ///< it does not know our key, or has another key than we believe
    };
    Q_ENUM(Loss)

    explicit WorkerLink(const QString& endpoint, const CurveKeys& keys = {}, QObject* parent = nullptr);
    /// Waits for the thread, a few milliseconds. closeLater() does not.
    ~WorkerLink() override;

    /// False if so much waits that the worker must have stopped reading.
    bool send(const Outgoing& outgoing);
    QVector<Incoming> takeIncoming();

    /// End the thread, emit nothing more, and delete this object when the thread has ended.
    void closeLater();

Q_SIGNALS:
    void messagesArrived(); ///< call takeIncoming(); emitted once until it is called
    void connectionLost(lampblack::WorkerLink::Loss loss);

private:
    void run() override;
    void setUp(zmq::socket_t& socket);
    /// Until the connection is closed or lost. `events` reports those of `socket`.
    Loss exchangeMessages(zmq::socket_t& socket, zmq::socket_t& wake, zmq::socket_t& events);
    bool receivePending(zmq::socket_t& socket); ///< false if more may be waiting
    void handleMessage(const std::vector<zmq::message_t>& frames);
    void queueIncoming(const Incoming& incoming);
    void sendPending(zmq::socket_t& socket);
    void wakeUp();
    bool inboxIsFull();
    bool outboxIsEmpty();

    const QByteArray mEndpoint;
    const CurveKeys mKeys;
    zmq::context_t mContext{1};
    zmq::socket_t mWake; ///< wakes the thread

    QMutex mMutex; ///< guards the next three
    Outbox mOutbox;
    Inbox mInbox;
    bool mClosing = false;

    // Used by the thread only.
    bool mWasGreeted = false;
    qint64 mTimeoutMs = 0;  ///< how long no status may come
    qint64 mLastTickMs = 0; ///< when the last status came, by a monotonic clock
    int mRefusals = 0;
    bool mReportedTooLong = false; ///< reported once only: a dragged light would repeat it
};

} // namespace lampblack
