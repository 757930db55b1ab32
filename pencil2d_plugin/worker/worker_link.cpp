#include "worker/worker_link.h"

#include "protocol/codec.h"

#include <QDeadlineTimer>
#include <QLoggingCategory>
#include <QMutexLocker>

#include <csignal>
#include <iterator>

namespace lampblack
{

namespace
{

Q_LOGGING_CATEGORY(log, "lampblack.worker")

constexpr int HighWater = 4; // more waits in the outbox, where it can be replaced
constexpr int HeartbeatMs = 1000;
// Long, because on a machine that has much else to do, a worker that is well is silent for seconds.
constexpr int HeartbeatTimeoutMs = 10000;
constexpr qint64 GreetingMs = 30000;
constexpr qint64 FarGreetingMs = 10000; ///< of a worker that has long been started
constexpr int MissedStatuses = 10;
constexpr int MaxRefusalsLogged = 10;
constexpr int MaxAtOnce = 64;           // messages read before anything is sent again
constexpr size_t MaxFrames = 1 + 4 + 1; // one more than allowed is enough for the decoder to refuse

qint64 nowMs()
{
    return QDeadlineTimer::current(Qt::PreciseTimer).deadline();
}

zmq::message_t messageOf(const QByteArray& bytes)
{
    return zmq::message_t(bytes.constData(), static_cast<size_t>(bytes.size()));
}

/// Does not copy the pixels: ZeroMQ holds a reference to the image until they are sent.
zmq::message_t messageOf(const QImage& image)
{
    auto* kept = new QImage(image);
    const auto release = [](void*, void* hint)
    {
        delete static_cast<QImage*>(hint);
    };
    return zmq::message_t(const_cast<uchar*>(kept->constBits()), static_cast<size_t>(kept->sizeInBytes()),
                          release, kept);
}

/// Signals of the host (such as SIGCHLD) must not interrupt system calls of this thread.
void maskSignals()
{
    sigset_t signalsToBlock;
    sigfillset(&signalsToBlock);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP})
    {
        sigdelset(&signalsToBlock, fault);
    }
    pthread_sigmask(SIG_BLOCK, &signalsToBlock, nullptr);
}

/// Whether the handshake has failed: no other events are asked for.
bool isRefused(zmq::socket_t& events)
{
    zmq::message_t event;
    return events.recv(event, zmq::recv_flags::dontwait).has_value();
}

protocol::Error errorOf(protocol::ErrorCode code, const QString& details)
{
    protocol::Error error;
    error.code = protocol::name(code);
    error.details = details;
    error.fatal = code == protocol::ErrorCode::VersionMismatch;
    return error;
}

} // namespace

WorkerLink::WorkerLink(const QString& endpoint, const CurveKeys& keys, QObject* parent)
    : QThread(parent), mEndpoint(endpoint.toUtf8()), mKeys(keys), mWake(mContext, zmq::socket_type::pair)
{
    qRegisterMetaType<Loss>("lampblack::WorkerLink::Loss");
    mWake.bind("inproc://wake");
    start();
}

WorkerLink::~WorkerLink()
{
    {
        const QMutexLocker lock(&mMutex);
        mClosing = true;
    }
    wakeUp();
    wait();
}

void WorkerLink::closeLater()
{
    disconnect(this, nullptr, nullptr, nullptr);
    connect(this, &QThread::finished, this, &QObject::deleteLater);
    {
        const QMutexLocker lock(&mMutex);
        mClosing = true;
    }
    wakeUp();
    if (isFinished())
    {
        deleteLater();
    }
}

bool WorkerLink::send(const Outgoing& outgoing)
{
    {
        const QMutexLocker lock(&mMutex);
        if (!mOutbox.push(outgoing))
        {
            return false;
        }
    }
    wakeUp();
    return true;
}

QVector<Incoming> WorkerLink::takeIncoming()
{
    QVector<Incoming> taken;
    bool wasFull = false;
    {
        const QMutexLocker lock(&mMutex);
        wasFull = mInbox.isFull();
        taken = mInbox.takeAll();
    }
    if (wasFull)
    {
        wakeUp();
    }
    return taken;
}

void WorkerLink::wakeUp()
{
    try
    {
        // If this would block, enough wake-ups are pending.
        mWake.send(zmq::message_t(), zmq::send_flags::dontwait);
    }
    catch (const zmq::error_t&)
    {
        return; // the thread has ended or is about to end
    }
}

bool WorkerLink::inboxIsFull()
{
    const QMutexLocker lock(&mMutex);
    return mInbox.isFull();
}

bool WorkerLink::outboxIsEmpty()
{
    const QMutexLocker lock(&mMutex);
    return mOutbox.isEmpty();
}

void WorkerLink::setUp(zmq::socket_t& socket)
{
    socket.set(zmq::sockopt::linger, 0);
    socket.set(zmq::sockopt::sndhwm, HighWater);
    socket.set(zmq::sockopt::rcvhwm, HighWater);
    socket.set(zmq::sockopt::maxmsgsize, static_cast<int64_t>(protocol::Limits().planeBytes));
    socket.set(zmq::sockopt::heartbeat_ivl, HeartbeatMs);
    socket.set(zmq::sockopt::heartbeat_timeout, HeartbeatTimeoutMs);
    if (!mKeys.worker.empty())
    {
        socket.set(zmq::sockopt::curve_serverkey, mKeys.worker);
        socket.set(zmq::sockopt::curve_publickey, mKeys.ownPublic);
        socket.set(zmq::sockopt::curve_secretkey, mKeys.ownSecret);
    }
}

void WorkerLink::run()
{
    maskSignals();
    Loss loss = Loss::Silent;
    try
    {
        zmq::socket_t socket(mContext, zmq::socket_type::dealer);
        setUp(socket);
        constexpr int Refusals = ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL | ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL |
                                 ZMQ_EVENT_HANDSHAKE_FAILED_AUTH;
        zmq_socket_monitor(socket.handle(), "inproc://events", Refusals);
        zmq::socket_t events(mContext, zmq::socket_type::pair);
        events.connect("inproc://events");
        socket.connect(mEndpoint.constData());
        zmq::socket_t wake(mContext, zmq::socket_type::pair);
        wake.connect("inproc://wake");
        loss = exchangeMessages(socket, wake, events);
    }
    catch (const std::exception& error)
    {
        qCWarning(log) << "The connection to the worker broke:" << error.what();
    }
    Q_EMIT connectionLost(loss);
}

WorkerLink::Loss WorkerLink::exchangeMessages(zmq::socket_t& socket, zmq::socket_t& wake,
                                              zmq::socket_t& events)
{
    mTimeoutMs = mKeys.worker.empty() ? GreetingMs : FarGreetingMs;
    mLastTickMs = nowMs();
    for (;;)
    {
        {
            const QMutexLocker lock(&mMutex);
            if (mClosing)
            {
                return Loss::Silent;
            }
        }
        const bool reading = !inboxIsFull();
        if (!reading)
        {
            mLastTickMs = nowMs(); // we do not read, so we cannot know
        }
        const int awaited = (reading ? ZMQ_POLLIN : 0) | (outboxIsEmpty() ? 0 : ZMQ_POLLOUT);
        zmq::pollitem_t items[] = {{wake.handle(), 0, ZMQ_POLLIN, 0},
                                   {events.handle(), 0, ZMQ_POLLIN, 0},
                                   {socket.handle(), 0, static_cast<short>(awaited), 0}};
        const qint64 left = mLastTickMs + mTimeoutMs - nowMs();
        zmq::poll(items, std::size(items), std::chrono::milliseconds(qMax(qint64(0), left) + 1));
        zmq::message_t nudge;
        while (wake.recv(nudge, zmq::recv_flags::dontwait))
        {
        }
        if (isRefused(events))
        {
            return Loss::Refused;
        }
        sendPending(socket);
        if (reading)
        {
            const bool drained = receivePending(socket);
            if (drained && nowMs() - mLastTickMs > mTimeoutMs)
            {
                return mWasGreeted ? Loss::Silent : Loss::NotReached;
            }
        }
    }
}

void WorkerLink::sendPending(zmq::socket_t& socket)
{
    while ((socket.get(zmq::sockopt::events) & ZMQ_POLLOUT) != 0)
    {
        Outgoing outgoing;
        {
            const QMutexLocker lock(&mMutex);
            if (mOutbox.isEmpty())
            {
                return;
            }
            outgoing = mOutbox.takeFirst();
        }
        const std::optional<QByteArray> header = protocol::encode(outgoing.message);
        if (!header)
        {
            if (!std::exchange(mReportedTooLong, true))
            {
                const QString type = protocol::typeOf(outgoing.message);
                queueIncoming({errorOf(protocol::ErrorCode::HeaderTooLarge, type), {}});
            }
            continue;
        }
        const auto flagsOf = [](bool isLast)
        {
            return isLast ? zmq::send_flags::dontwait : zmq::send_flags::sndmore;
        };
        socket.send(messageOf(*header), flagsOf(outgoing.planes.isEmpty()));
        for (int i = 0; i < outgoing.planes.size(); ++i)
        {
            socket.send(messageOf(outgoing.planes[i]), flagsOf(i + 1 == outgoing.planes.size()));
        }
    }
}

bool WorkerLink::receivePending(zmq::socket_t& socket)
{
    for (int count = 0; count < MaxAtOnce && !inboxIsFull(); ++count)
    {
        std::vector<zmq::message_t> frames(1);
        if (!socket.recv(frames.back(), zmq::recv_flags::dontwait))
        {
            return true;
        }
        while (frames.back().more())
        {
            if (frames.size() < MaxFrames)
            {
                frames.emplace_back();
            }
            // Messages arrive complete: the other frames are there.
            (void)socket.recv(frames.back(), zmq::recv_flags::none);
        }
        handleMessage(frames);
    }
    return false;
}

void WorkerLink::handleMessage(const std::vector<zmq::message_t>& frames)
{
    QVector<protocol::Bytes> bytes;
    for (const zmq::message_t& frame : frames)
    {
        bytes.append({frame.data(), static_cast<qint64>(frame.size())});
    }
    const protocol::Decoded decoded = protocol::decode(bytes, protocol::Sender::Worker);
    if (const auto* refusal = std::get_if<protocol::Refusal>(&decoded))
    {
        if (++mRefusals <= MaxRefusalsLogged)
        {
            qCWarning(log) << "A message of the worker was dropped:" << protocol::name(refusal->code)
                           << refusal->details;
        }
        if (refusal->code == protocol::ErrorCode::VersionMismatch)
        {
            queueIncoming({errorOf(refusal->code, refusal->details), {}});
        }
        return;
    }
    const auto& received = std::get<protocol::Received>(decoded);
    if (const auto* welcome = std::get_if<protocol::Welcome>(&received.message))
    {
        mWasGreeted = true;
        mTimeoutMs = MissedStatuses * welcome->statusMs;
        mLastTickMs = nowMs();
    }
    if (std::holds_alternative<protocol::Status>(received.message))
    {
        mLastTickMs = nowMs();
    }
    queueIncoming({received.message,
                   received.planes.isEmpty() ? QImage() : protocol::toImage(received.planes.first())});
}

void WorkerLink::queueIncoming(const Incoming& incoming)
{
    bool first = false;
    {
        const QMutexLocker lock(&mMutex);
        first = mInbox.isEmpty();
        mInbox.push(incoming);
    }
    if (first)
    {
        Q_EMIT messagesArrived();
    }
}

} // namespace lampblack
