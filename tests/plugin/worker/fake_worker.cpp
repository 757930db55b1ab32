// A worker process that follows a script. Started as `fake_worker -I -m lampblack serve --connection FILE
// ...`. LAMPBLACK_FAKE names the script, LAMPBLACK_FAKE_FOLDER a folder where it counts its launches and logs
// received headers. It does not use the client's codec, so that it can test it.
#include <QCoreApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMap>
#include <QSaveFile>
#include <QSet>
#include <QThread>

#include <zmq.hpp>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace
{

constexpr int StatusMs = 150;
constexpr int Side = 8;

using Frames = std::vector<QByteArray>;

class FakeWorker
{
public:
    FakeWorker(const QString& connection, const QString& device)
        : mConnection(connection),
          mCard(device == QLatin1String("auto") ? QStringLiteral("Paper Card") : QString())
    {
        QFile count(mFolder.filePath(QStringLiteral("launches")));
        (void)count.open(QIODevice::ReadWrite | QIODevice::Append);
        count.write("x");
        mFirst = count.size() == 1;
    }

    int run()
    {
        if (mScript == "absent" || (mScript == "stumbles" && mFirst))
        {
            std::fputs("It refuses to start.\n", stderr);
            return 1;
        }
        if (mScript == "late")
        {
            QThread::msleep(400);
        }
        const QString endpoint =
            QStringLiteral("ipc://") + QFileInfo(mConnection).absolutePath() + QStringLiteral("/socket");
        mRouter.set(zmq::sockopt::linger, 0);
        mRouter.set(zmq::sockopt::sndhwm, 0); // a flood is to arrive whole
        mRouter.bind(endpoint.toStdString());
        QSaveFile file(mConnection);
        (void)file.open(QIODevice::WriteOnly);
        file.write(QJsonDocument(QJsonObject{{QStringLiteral("lampblack"), mScript == "other_file" ? 2 : 1},
                                             {QStringLiteral("minor"), 0},
                                             {QStringLiteral("endpoint"), endpoint},
                                             {QStringLiteral("pid"), QCoreApplication::applicationPid()}})
                       .toJson());
        file.commit();
        QElapsedTimer life;
        life.start();
        while (!life.hasExpired(60000))
        {
            zmq::pollitem_t item{mRouter.handle(), 0, ZMQ_POLLIN, 0};
            zmq::poll(&item, 1, std::chrono::milliseconds(StatusMs / 3));
            if ((item.revents & ZMQ_POLLIN) != 0)
            {
                receive();
            }
            if (mGreeted && (!mTick.isValid() || mTick.hasExpired(StatusMs)))
            {
                mTick.start();
                status();
            }
        }
        return 0;
    }

private:
    void receive()
    {
        Frames frames;
        zmq::message_t part;
        (void)mRouter.recv(part);
        mIdentity = QByteArray(static_cast<const char*>(part.data()), static_cast<int>(part.size()));
        while (part.more())
        {
            (void)mRouter.recv(part);
            frames.emplace_back(static_cast<const char*>(part.data()), static_cast<int>(part.size()));
        }
        QFile log(mFolder.filePath(QStringLiteral("received")));
        (void)log.open(QIODevice::Append);
        log.write(frames.front() + '\n');
        log.close();
        const QJsonObject header = QJsonDocument::fromJson(frames.front()).object();
        const QString type = header.value(QLatin1String("type")).toString();
        if (type == QLatin1String("hello"))
        {
            greet();
        }
        else if (type == QLatin1String("put_frame"))
        {
            const QString digest = header.value(QLatin1String("digest")).toString();
            mShown[header.value(QLatin1String("frame")).toInt()] = digest;
            if (frames.size() > 1)
            {
                mHeld.insert(digest);
                show();
            }
            else if (!mHeld.contains(digest))
            {
                send(R"("type":"need_frame","frame":%1,"digest":"%2")",
                     {QString::number(header.value(QLatin1String("frame")).toInt()), digest});
            }
        }
        else if (type == QLatin1String("set_scene"))
        {
            mRevision = header.value(QLatin1String("revision")).toInt();
            if (mScript == "dies_of_light" && mFirst)
            {
                std::fputs("Blinded.\n", stderr);
                std::fflush(stderr);
                std::abort();
            }
            show();
        }
        else if (type == QLatin1String("preview"))
        {
            mLook = header;
            mPass = 0;
            show();
        }
        else if (type == QLatin1String("cancel"))
        {
            mLook = {};
        }
        else if (type == QLatin1String("get_palette"))
        {
            const int frame = header.value(QLatin1String("frame")).toInt();
            send(
                R"("type":"palette","request":%1,"frame":%2,"digest":"%3","swatches":[{"colour":"#ff0000","pixels":7}])",
                {number(header, "request"), QString::number(frame), mShown.value(frame)});
        }
        else if (type == QLatin1String("get_overlaps"))
        {
            const int frame = header.value(QLatin1String("frame")).toInt();
            send(
                R"("type":"overlaps","request":%1,"frame":%2,"digest":"%3","overlaps":[{"points":[{"x":1,"y":2},{"x":3,"y":2}],"front":"right","amount":4}])",
                {number(header, "request"), QString::number(frame), mShown.value(frame)});
        }
        else if (type == QLatin1String("get_rigs"))
        {
            rigs(header);
        }
        else if (type == QLatin1String("get_normals"))
        {
            normals(header);
        }
        else if (type == QLatin1String("render"))
        {
            render(header);
        }
    }

    void greet()
    {
        if (mScript == "silent")
        {
            return;
        }
        if (mScript == "late")
        {
            QThread::msleep(300);
        }
        if (mScript == "other_version")
        {
            sendRaw({R"({"lampblack":2,"type":"welcome"})"});
            return;
        }
        if (mScript == "full" && mFirst)
        {
            send(
                R"("type":"error","code":"too_many_clients","what":"The worker serves all it can.","fatal":true)");
            return;
        }
        mGreeted = true;
        send(
            QStringLiteral(
                R"("type":"welcome","minor":3,"session":"%1","worker_version":"fake","capabilities":[%2],"status_ms":%3)"),
            {QString::number(QCoreApplication::applicationPid()).rightJustified(32, QLatin1Char('0')),
             mScript == "no_layers" ? QString() : QStringLiteral("\"layers\",\"rigs\",\"normals\""),
             QString::number(StatusMs)});
        if (mScript == "babbles")
        {
            babble();
        }
    }

    /// Everything that no worker should send.
    void babble()
    {
        sendRaw({QByteArray()});
        sendRaw({QByteArray("\xff\xfe\x00garbage", 10)});
        sendRaw({R"({"lampblack":1,"type":"image")"});
        sendRaw({R"({"lampblack":1,"type":"hello","minor":0,"client":"a","client_version":"b"})"});
        sendRaw({R"({"lampblack":1,"type":"sing"})"});
        sendRaw({R"({"lampblack":1,"type":"status"})", "plane", "plane", "plane", "plane", "plane", "plane"});
        sendRaw({QByteArray(70000, ' ')});
        sendRaw({QByteArray(R"({"lampblack":1,"type":"bye","reason":)") + QByteArray(60000, '[')});
        send(R"("type":"done","request":77,"outcome":"finished","frames_done":1,"frames_total":1)");
        send(
            R"("type":"palette","request":1,"frame":9,"digest":"0000000000000000000000000000000000000000","swatches":[])");
        // An image whose plane is shorter than it says.
        sendRaw({imageHeader(1, 1, QByteArray(40, '0'), 0, 0), QByteArray(10, 'x')});
    }

    void status()
    {
        if (mScript == "hangs" && mFirst && mShownOnce)
        {
            QThread::sleep(600);
        }
        send(
            R"("type":"status","uptime_ms":1,"revision":0,"preview":"idle","job":"off","frames_held":%1,"frames_lit":%2,"card":"%3")",
            {QString::number(mHeld.size()), QString::number(mHeld.size()), mCard});
    }

    void show()
    {
        const int frame = mLook.value(QLatin1String("frame")).toInt();
        const QString digest = mShown.value(frame);
        if (mLook.isEmpty() || mRevision == 0 || !mHeld.contains(digest))
        {
            return;
        }
        mShownOnce = true;
        const int request = mLook.value(QLatin1String("request")).toInt();
        if (mScript == "stale")
        {
            image(request, frame, digest, mRevision, 5, 5);
            image(request, frame, digest, mRevision, 4, 4);     // an older pass
            image(request, frame, digest, mRevision - 1, 9, 9); // an older scene
            image(request, frame + 1, digest, mRevision, 9, 9); // another frame
            image(request, frame, QString(40, QLatin1Char('a')), mRevision, 9, 9);
            image(request + 100, frame, digest, mRevision, 9, 9); // a request that was not made
            image(request, frame, digest, mRevision, 6, 6);
            return;
        }
        const int count = mScript == "floods" ? 3000 : 1;
        for (int i = 0; i < count; ++i)
        {
            image(request, frame, digest, mRevision, mPass, mPass);
            ++mPass;
        }
    }

    void render(const QJsonObject& header)
    {
        const QString request = number(header, "request");
        const QString frames = header.value(QLatin1String("frames")).toString();
        const bool rest = !mFirst;
        send(R"("type":"progress","request":%1,"frame":1,"share":0.5,"frames_done":0,"frames_total":%2)",
             {request, rest ? QStringLiteral("2") : QStringLiteral("3")});
        if (mScript == "dies_rendering" && mFirst)
        {
            send(R"("type":"frame_done","request":%1,"frame":1,"path":"/tmp/a.0001.png")", {request});
            QThread::msleep(100);
            std::abort();
        }
        if (frames == QLatin1String("404"))
        {
            send(
                R"("type":"error","code":"unknown_frame","what":"No such drawing.","request":%1,"frame":404)",
                {request});
            return;
        }
        send(R"("type":"done","request":%1,"outcome":"finished","frames_done":2,"frames_total":2)",
             {request});
    }

    void normals(const QJsonObject& header)
    {
        const int frame = header.value(QLatin1String("frame")).toInt();
        const QString body =
            QStringLiteral(R"({"lampblack":1,"type":"normals","request":%1,"frame":%2,"digest":"%3",)"
                           R"("planes":[{"role":"picture","format":"rgba8_premultiplied",)"
                           R"("width":2,"height":1,"stride":8}]})")
                .arg(number(header, "request"))
                .arg(frame)
                .arg(mShown.value(frame));
        sendRaw({body.toLatin1(), QByteArray("\x80\x80\xff\xff\xff\x80\x80\xff")});
    }

    /// Two rigs: the picture of the first is of zeros, that of the second of ones.
    void rigs(const QJsonObject& header)
    {
        const int frame = header.value(QLatin1String("frame")).toInt();
        const int side = header.value(QLatin1String("side")).toInt();
        const QString body =
            QStringLiteral(R"({"lampblack":1,"type":"rigs","request":%1,"frame":%2,"digest":"%3",)"
                           R"("names":["key","moon"],"rigs":["{}","{}"],"planes":[{"role":"picture",)"
                           R"("format":"rgba8_premultiplied","width":%4,"height":%5,"stride":%6}]})")
                .arg(number(header, "request"))
                .arg(frame)
                .arg(mShown.value(frame))
                .arg(side)
                .arg(2 * side)
                .arg(4 * side);
        sendRaw({body.toLatin1(), QByteArray(4 * side * side, '\0') + QByteArray(4 * side * side, '\1')});
    }

    QByteArray imageHeader(int request, int frame, const QByteArray& digest, int revision, int pass)
    {
        return QStringLiteral(R"({"lampblack":1,"type":"image","request":%1,"frame":%2,"digest":"%3",)"
                              R"("revision":%4,"show":"lit","pass":%5,"spp":1,"converged":false,)"
                              R"("crop":{"x":0,"y":0,"width":8,"height":8},"planes":[{"role":"picture",)"
                              R"("format":"rgba8_premultiplied","width":8,"height":8,"stride":32}]})")
            .arg(request)
            .arg(frame)
            .arg(QString::fromLatin1(digest))
            .arg(revision)
            .arg(pass)
            .toLatin1();
    }

    /// A picture all of whose bytes are `shade`.
    void image(int request, int frame, const QString& digest, int revision, int pass, int shade)
    {
        sendRaw({imageHeader(request, frame, digest.toLatin1(), revision, pass),
                 QByteArray(Side * Side * 4, static_cast<char>(shade % 256))});
        if (mScript == "stale")
        {
            QThread::msleep(20); // so that each is looked at
        }
    }

    static QString number(const QJsonObject& header, const char* name)
    {
        return QString::number(header.value(QLatin1String(name)).toInt());
    }

    void send(const char* body, const QStringList& values = {}) { send(QString::fromLatin1(body), values); }

    void send(QString body, const QStringList& values = {})
    {
        for (const QString& value : values)
        {
            body = body.arg(value);
        }
        sendRaw({"{\"lampblack\":1," + body.toLatin1() + "}"});
    }

    void sendRaw(const Frames& frames)
    {
        mRouter.send(zmq::buffer(mIdentity.constData(), static_cast<size_t>(mIdentity.size())),
                     zmq::send_flags::sndmore);
        for (size_t i = 0; i < frames.size(); ++i)
        {
            const auto flags = i + 1 < frames.size() ? zmq::send_flags::sndmore : zmq::send_flags::none;
            mRouter.send(zmq::buffer(frames[i].constData(), static_cast<size_t>(frames[i].size())), flags);
        }
    }

    const QString mConnection;
    const QString mCard; ///< that it finds; a processor is none
    const QByteArray mScript = qgetenv("LAMPBLACK_FAKE");
    const QDir mFolder{qEnvironmentVariable("LAMPBLACK_FAKE_FOLDER")};
    bool mFirst = true; ///< of the launches with this folder
    zmq::context_t mContext{1};
    zmq::socket_t mRouter{mContext, zmq::socket_type::router};
    QByteArray mIdentity;
    bool mGreeted = false;
    bool mShownOnce = false;
    QElapsedTimer mTick;
    QMap<int, QString> mShown;
    QSet<QString> mHeld;
    QJsonObject mLook;
    int mRevision = 0;
    int mPass = 0;
};

} // namespace

int main(int argc, char** argv)
{
    QCoreApplication app(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    if (arguments.mid(1, 5) != QStringList{QStringLiteral("-I"), QStringLiteral("-m"),
                                           QStringLiteral("lampblack"), QStringLiteral("serve"),
                                           QStringLiteral("--connection")} ||
        arguments.value(7) != QLatin1String("--parent-pid") ||
        arguments.value(9) != QLatin1String("--device"))
    {
        return 2;
    }
    return FakeWorker(arguments[6], arguments.value(10)).run();
}
