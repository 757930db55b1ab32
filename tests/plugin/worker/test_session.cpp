// WorkerSession with a worker process that follows a script.
#include "support/session_test.h"

#include <QElapsedTimer>
#include <QJsonArray>
#include <QJsonObject>
#include <QSignalSpy>
#include <QTimer>

#include <csignal>

using namespace lampblack;

namespace
{

/// Logs the longest time between two turns of the event loop; nothing is asserted.
class Watch : public QObject
{
public:
    Watch()
    {
        mClock.start();
        connect(&mTimer, &QTimer::timeout, this, [this] { mLongest = qMax(mLongest, mClock.restart()); });
        mTimer.start(1);
    }
    ~Watch() override { qInfo("longest gap of the event loop: %lld ms", mLongest); }

private:
    QTimer mTimer;
    QElapsedTimer mClock;
    qint64 mLongest = 0;
};

} // namespace

class TestWorkerSession : public SessionTest
{
    Q_OBJECT

private Q_SLOTS:
    void aDrawingUnderALightIsShown_data()
    {
        QTest::addColumn<QByteArray>("script");
        QTest::addColumn<int>("launches");
        QTest::newRow("at once") << QByteArray("good") << 1;
        QTest::newRow("late") << QByteArray("late") << 1;
        QTest::newRow("died before it was ready") << QByteArray("stumbles") << 2;
        QTest::newRow("died in mid-session") << QByteArray("dies_of_light") << 2;
        QTest::newRow("served others") << QByteArray("full") << 2;
        QTest::newRow("talked nonsense") << QByteArray("babbles") << 1;
    }

    void aDrawingUnderALightIsShown()
    {
        QFETCH(QByteArray, script);
        QFETCH(int, launches);
        const Watch watch;
        const auto session = open(script);
        lookAtOne(*session);
        QTRY_VERIFY_WITH_TIMEOUT(!mImages.isEmpty(), 10000);
        QCOMPARE(mImages[0].frame, 1);
        QCOMPARE(mImages[0].picture.size(), QSize(Side, Side));
        QCOMPARE(mImages[0].crop, QRectF(0, 0, Side, Side));
        QVERIFY(session->isCurrent(mImages.last()));
        QTRY_COMPARE(session->state(), Worker::State::Ready);
        QCOMPARE(launchesCounted(), launches);
        session->setScene(sceneLitFrom(5));
        QVERIFY(!session->isCurrent(mImages.last()));
        QTRY_VERIFY(session->isCurrent(mImages.last()));
    }

    void whatIsStaleIsDropped()
    {
        const auto session = open("stale");
        lookAtOne(*session);
        QTRY_COMPARE(mImages.size(), 2);
        QTest::qWait(100);
        QCOMPARE(mImages.size(), 2);
        QCOMPARE(mImages[0].pass, 5);
        QCOMPARE(mImages[1].pass, 6);
        QCOMPARE(mImages[1].picture.constBits()[0], uchar(6));
    }

    void aFloodIsPassedOver()
    {
        const Watch watch;
        const auto session = open("floods");
        lookAtOne(*session);
        QTRY_VERIFY_WITH_TIMEOUT(!mImages.isEmpty() && mImages.last().pass == 2999, 20000);
        qInfo("%d of 3000 images reached the user interface", int(mImages.size()));
        for (int i = 1; i < mImages.size(); ++i)
        {
            QVERIFY(mImages[i].pass > mImages[i - 1].pass);
        }
    }

    void aWorkerThatStopsTickingIsReplaced()
    {
        const Watch watch;
        const auto session = open("hangs");
        lookAtOne(*session);
        QTRY_VERIFY(!mImages.isEmpty());
        QTRY_COMPARE_WITH_TIMEOUT(session->state(), Worker::State::Restarting, 10000);
        mImages.clear();
        QTRY_VERIFY_WITH_TIMEOUT(!mImages.isEmpty(), 10000);
        QTRY_COMPARE(session->state(), Worker::State::Ready);
        QVERIFY(mProblems.isEmpty());
    }

    void killedWhileALightIsDraggedThePictureReturns()
    {
        const Watch watch;
        const auto session = open("good");
        lookAtOne(*session);
        QTRY_VERIFY(!mImages.isEmpty());
        kill(static_cast<pid_t>(session->workerPid()), SIGKILL);
        bool restarting = false;
        connect(session.get(), &Worker::stateChanged, this,
                [&restarting](Worker::State state) { restarting |= state == Worker::State::Restarting; });
        mImages.clear();
        for (int x = 0; x < 100; ++x)
        {
            session->setScene(sceneLitFrom(x));
            QTest::qWait(2);
        }
        QTRY_VERIFY(!mImages.isEmpty() && session->isCurrent(mImages.last()));
        QVERIFY(restarting);
        QVERIFY(mProblems.isEmpty());
    }

    void aDragNeverMakesTheSceneWait()
    {
        const Watch watch;
        const auto session = open("good");
        lookAtOne(*session);
        QTRY_VERIFY(!mImages.isEmpty());
        for (int x = 0; x < 20000; ++x)
        {
            session->setScene(sceneLitFrom(x));
        }
        QTRY_VERIFY(session->isCurrent(mImages.last()));
        int scenes = 0;
        const QList<QJsonObject> headers = received();
        for (const QJsonObject& header : headers)
        {
            scenes += header.value(QLatin1String("type")) == QLatin1String("set_scene") ? 1 : 0;
        }
        qInfo("%d of 20000 scenes were sent", scenes);
        QVERIFY(scenes < 10000);
    }

    void anotherVersionIsToldOnceAndLeftAlone_data()
    {
        QTest::addColumn<QByteArray>("script");
        QTest::newRow("by its file") << QByteArray("other_file");
        QTest::newRow("by its words") << QByteArray("other_version");
    }

    void anotherVersionIsToldOnceAndLeftAlone()
    {
        QFETCH(QByteArray, script);
        const auto session = open(script);
        QTRY_COMPARE(mProblems.size(), 1);
        QVERIFY(mProblems[0].remedy.contains(QStringLiteral("Update both")));
        QCOMPARE(session->state(), Worker::State::Absent);
        QTest::qWait(100);
        QCOMPARE(launchesCounted(), 1);
        QCOMPARE(mProblems.size(), 1);
    }

    void anotherDeviceIsAnotherProcess()
    {
        const auto session = open("good");
        const QSignalSpy cards(session.get(), &Worker::cardFound);
        QTRY_COMPARE(cards.count(), 1);
        QCOMPARE(cards[0][0].toString(), QStringLiteral("Paper Card"));
        session->setDevice(Worker::Device::Processor);
        QTRY_COMPARE(launchesCounted(), 2);
        session->setDevice(Worker::Device::Auto);
        QTRY_COMPARE(cards.count(), 2);
        QCOMPARE(launchesCounted(), 3);
        QCOMPARE(mProblems.size(), 0);
    }

    void withoutAWorkerAllElseGoesOn()
    {
        qputenv("LAMPBLACK_FAKE", "good");
        WorkerSession session({QStringLiteral("/nowhere/python"), QStringLiteral("the test")});
        watch(session);
        session.start();
        QCOMPARE(session.state(), Worker::State::Starting);
        lookAtOne(session);
        QTRY_COMPARE(mProblems.size(), 1);
        QCOMPARE(session.state(), Worker::State::Absent);
        const QSignalSpy done(&session, &Worker::renderDone);
        session.render(QStringLiteral("1"), QStringLiteral("/tmp/a.%04d.png"), Quality::Final);
        QTRY_COMPARE(done.count(), 1);
        QCOMPARE(done[0][1].toString(), QStringLiteral("failed"));
        session.cancelPreview();
        session.dropAllFrames();
        session.stop();
    }

    void aDrawingThatWasLetGoIsAskedOfTheHost()
    {
        qputenv("LAMPBLACK_FAKE", "good");
        WorkerSession session({QStringLiteral(LAMPBLACK_FAKE_WORKER), QString()},
                              2048); // one sheet at a time
        watch(session);
        session.putFrame(1, sheet(Qt::red));
        session.putFrame(2, sheet(Qt::green));
        session.putFrame(3, sheet(Qt::blue));
        QTest::qWait(100);
        connect(&session, &Worker::frameNeeded, &session,
                [&session](int frame) { session.putFrame(frame, sheet(frame == 1 ? Qt::red : Qt::green)); });
        session.start();
        session.setScene(sceneLitFrom(1));
        session.requestPreview(1, Show::Lit, QRectF(0, 0, Side, Side), QSize(Side, Side));
        QTRY_VERIFY(!mImages.isEmpty());
        session.requestPreview(2, Show::Lit, QRectF(0, 0, Side, Side), QSize(Side, Side));
        QTRY_COMPARE(mImages.last().frame, 2);
    }

    void aRedrawnFrameIsShownAnew()
    {
        const auto session = open("good");
        lookAtOne(*session);
        QTRY_VERIFY(!mImages.isEmpty());
        const PreviewImage before = mImages.last();
        session->putFrame(1, sheet(Qt::blue));
        QVERIFY2(session->fit(before) == Worker::Fit::Unknown, "the new drawing has no digest yet");
        QTRY_VERIFY(mImages.last().digest != before.digest);
        QVERIFY(session->fit(before) == Worker::Fit::OldDrawing);
        QVERIFY(session->isCurrent(mImages.last()));
    }

    void aPaletteIsAnswered()
    {
        const auto session = open("good");
        const QSignalSpy palette(session.get(), &Worker::paletteArrived);
        session->requestPalette(1); // before there is such a frame
        session->putFrame(1, sheet(Qt::red));
        QTRY_COMPARE(palette.count(), 1);
        QCOMPARE(palette[0][1].value<QVector<Swatch>>().value(0).colour, QStringLiteral("#ff0000"));
    }

    void overlapsAreAnswered()
    {
        const auto session = open("good");
        const QSignalSpy answered(session.get(), &Worker::overlapsArrived);
        session->requestOverlaps(1);
        session->putFrame(1, sheet(Qt::red));
        QTRY_COMPARE(answered.count(), 1);
        const Overlap overlap = answered[0][1].value<QVector<Overlap>>().value(0);
        QCOMPARE(overlap.points.size(), 2);
        QCOMPARE(overlap.points[1].x, 3.0);
        QCOMPARE(overlap.front, FrontSide::Right);
    }

    void rigsComeWithTheirPictures()
    {
        const auto session = open("good");
        const QSignalSpy arrived(session.get(), &Worker::rigsArrived);
        session->requestRigs(1, 20);
        session->putFrame(1, sheet(Qt::red));
        session->setScene(sceneLitFrom(1));
        session->requestRigs(1, 20);
        QTRY_COMPARE(arrived.count(), 1);
        const auto rigs = arrived[0][1].value<QVector<RigSketch>>();
        QCOMPARE(rigs.size(), 2);
        QCOMPARE(rigs[1].name, QStringLiteral("moon"));
        QCOMPARE(rigs[1].picture.size(), QSize(20, 20));
        QCOMPARE(rigs[0].picture.constScanLine(19)[79], uchar(0));
        QCOMPARE(rigs[1].picture.constScanLine(0)[0], uchar(1));
    }

    void normalsAreAnswered()
    {
        const auto session = open("good");
        const QSignalSpy arrived(session.get(), &Worker::normalsArrived);
        session->putFrame(1, sheet(Qt::red));
        session->setScene(sceneLitFrom(1));
        session->requestNormals(1);
        QTRY_COMPARE(arrived.count(), 1);
        QCOMPARE(arrived[0][0].toInt(), 1);
        const auto picture = arrived[0][1].value<QImage>();
        QCOMPARE(picture.size(), QSize(2, 1));
        QCOMPARE(picture.pixelColor(1, 0), QColor(255, 128, 128));
    }

    void layersAreSentApart_data()
    {
        QTest::addColumn<QByteArray>("script");
        QTest::addColumn<QStringList>("layers");
        QTest::newRow("to a worker that takes them")
            << QByteArray("good") << QStringList{QStringLiteral("body"), QStringLiteral("left arm")};
        QTest::newRow("but not to another") << QByteArray("no_layers") << QStringList();
    }

    void layersAreSentApart()
    {
        QFETCH(QByteArray, script);
        QFETCH(QStringList, layers);
        const auto session = open(script);
        lookAtOne(*session);
        session->putFrame(
            1, sheet(Qt::red), {},
            {{QStringLiteral("body"), sheet(Qt::red)}, {QStringLiteral("left\narm"), sheet(Qt::green)}});
        QTRY_VERIFY(!mImages.isEmpty() && session->isCurrent(mImages.last()));
        QJsonObject sent;
        const QList<QJsonObject> headers = received();
        for (const QJsonObject& header : headers)
        {
            if (!header.value(QLatin1String("planes")).toArray().isEmpty())
                sent = header;
        }
        QCOMPARE(sent.value(QLatin1String("layers")).toVariant().toStringList(), layers);
        QCOMPARE(sent.value(QLatin1String("planes")).toArray().size(), 1 + layers.size());
    }

    void nothingOfLooksThatCannotBeReachesTheWorker()
    {
        const auto session = open("good");
        lookAtOne(*session);
        QTRY_VERIFY(!mImages.isEmpty());
        session->requestPreview(1, Show::Lit, QRectF(0, 0, qQNaN(), 5), QSize(5, 5));
        session->requestPreview(1, Show::Lit, QRectF(), QSize(5, 5));
        session->requestPreview(-3, Show::Lit, QRectF(0, 0, 5, 5), QSize(5, 5));
        session->requestPreview(1, Show::Lit, QRectF(-1e9, 0, 1e9, 1e-9), QSize(100000, 50000));
        QTRY_COMPARE(received().last().value(QLatin1String("type")).toString(), QStringLiteral("preview"));
        const QJsonObject last = received().last();
        QCOMPARE(last.value(QLatin1String("width")).toInt(), 4096);
        QCOMPARE(last.value(QLatin1String("height")).toInt(), 2048);
        QCOMPARE(last[QStringLiteral("crop")][QStringLiteral("x")].toDouble(), -100000.0);
        QCOMPARE(last[QStringLiteral("crop")][QStringLiteral("height")].toDouble(), 0.01);
    }
};

QTEST_GUILESS_MAIN(TestWorkerSession)
#include "test_session.moc"
