// The parts of WorkerSession, each alone.
#include "own_folder.h"
#include "protocol/planes.h"
#include "worker/frame_list.h"
#include "worker/frame_store.h"
#include "worker/image_rank.h"
#include "worker/inbox.h"
#include "worker/interpreter.h"
#include "worker/outbox.h"

#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

using namespace lampblack;

namespace
{

QImage sheet(QRgb colour, int side = 16)
{
    QImage image(side, side, QImage::Format_RGBA8888);
    image.fill(QColor(colour));
    return image;
}

QStringList typesIn(Outbox& outbox)
{
    QStringList types;
    while (!outbox.isEmpty())
    {
        types.append(protocol::typeOf(outbox.takeFirst().message));
    }
    return types;
}

protocol::PutFrame shows(int frame, const QByteArray& digest)
{
    return {frame, digest, {}, {}, {}};
}

} // namespace

class TestWorkerParts : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aFolderIsNamedAsTheWorkerExpects()
    {
        // `lampblack/own_folder.py` removes those of processes that have ended.
        const QTemporaryDir folder(ownFolderTemplate());
        QVERIFY(folder.isValid());
        const QString own = QStringLiteral("lampblack-%1-\\w{8}").arg(QCoreApplication::applicationPid());
        const QString name = QFileInfo(folder.path()).fileName();
        QVERIFY(QRegularExpression(QRegularExpression::anchoredPattern(own)).match(name).hasMatch());
    }

    void theNewestSceneGoesWhereTheFirstStood()
    {
        Outbox outbox;
        for (quint64 revision = 1; revision <= 1000; ++revision)
        {
            outbox.push({protocol::SetScene{revision, {}}, {}});
            outbox.push({protocol::Preview{revision, 1, {}, 1, 1}, {}});
        }
        QCOMPARE(std::get<protocol::SetScene>(outbox.takeFirst().message).revision, quint64(1000));
        QCOMPARE(std::get<protocol::Preview>(outbox.takeFirst().message).request, quint64(1000));
        QVERIFY(outbox.isEmpty());
    }

    void aLookComesAfterAllThatWasAskedBeforeIt()
    {
        Outbox outbox;
        outbox.push({protocol::Preview{1, 1, {}, 1, 1}, {}});
        outbox.push({protocol::GetPalette{2, 1}, {}});
        outbox.push({protocol::View{3, 1, protocol::Show::Relief, {}, 1, 1}, {}});
        QCOMPARE(typesIn(outbox), (QStringList{QStringLiteral("get_palette"), QStringLiteral("view")}));
    }

    void nothingIsReplacedAcrossARender()
    {
        Outbox outbox;
        outbox.push({protocol::SetScene{1, {}}, {}});
        outbox.push({protocol::Render(), {}});
        outbox.push({protocol::SetScene{2, {}}, {}});
        outbox.push({protocol::SetScene{3, {}}, {}});
        QCOMPARE(std::get<protocol::SetScene>(outbox.takeFirst().message).revision, quint64(1));
        QVERIFY(std::holds_alternative<protocol::Render>(outbox.takeFirst().message));
        QCOMPARE(std::get<protocol::SetScene>(outbox.takeFirst().message).revision, quint64(3));
        QVERIFY(outbox.isEmpty());
    }

    void pixelsThatWereAskedForAreNotLostToAnAnnouncement()
    {
        Outbox outbox;
        outbox.push({shows(1, "a"), {sheet(0xff0000)}});
        outbox.push({shows(1, "a"), {}});
        QVERIFY(!outbox.takeFirst().planes.isEmpty());
        outbox.push({shows(1, "a"), {sheet(0xff0000)}});
        outbox.push({shows(1, "b"), {}});
        QVERIFY(outbox.takeFirst().planes.isEmpty());
        QVERIFY(outbox.isEmpty());
    }

    void aThousandRequestsWaitAndNoMore()
    {
        Outbox outbox;
        int taken = 0;
        for (quint64 i = 0; i < 2000; ++i)
        {
            taken += outbox.push({protocol::GetPalette{i, 1}, {}}) ? 1 : 0;
        }
        QCOMPARE(taken, 1000);
        QVERIFY(outbox.push({protocol::SetScene{1, {}}, {}}));
        outbox.takeFirst();
        QVERIFY(outbox.push({protocol::Cancel{1}, {}}));
    }

    void ofImagesOnlyTheNewestWaits()
    {
        Inbox inbox;
        for (quint64 i = 1; i <= 500; ++i)
        {
            protocol::Image image;
            image.pass = i;
            inbox.push({image, sheet(0xffffff)});
            inbox.push({protocol::Status(), {}});
            inbox.push({protocol::FrameDone{1, int(i), QStringLiteral("/a"), false}, {}});
        }
        const QVector<Incoming> taken = inbox.takeAll();
        QCOMPARE(taken.size(), 502);
        QVERIFY(inbox.isEmpty());
        for (const Incoming& incoming : taken)
        {
            if (const auto* image = std::get_if<protocol::Image>(&incoming.message))
            {
                QCOMPARE(image->pass, quint64(500));
            }
        }
    }

    void imagesRiseByRequestThenDrawingThenRevisionThenPass()
    {
        const ImageRank rank{5, 5, 5, 5};
        QVERIFY(!(rank < rank));
        QVERIFY(rank < (ImageRank{5, 5, 5, 6}));
        QVERIFY(rank < (ImageRank{5, 5, 6, 0}));
        QVERIFY(rank < (ImageRank{5, 6, 0, 0}));
        QVERIFY(rank < (ImageRank{6, 0, 0, 0}));
    }

    void frameListsGoThereAndBack_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("shortest");
        QTest::newRow("one") << "7"
                             << "7";
        QTest::newRow("range") << "1-20"
                               << "1-20";
        QTest::newRow("steps") << "1-20x2,25"
                               << "1-19x2,25";
        QTest::newRow("overlap") << "5,1-3,2-4"
                                 << "1-5";
        QTest::newRow("pairs") << "1,3,9"
                               << "1,3,9";
        QTest::newRow("backwards") << "3-1"
                                   << "";
        QTest::newRow("standing") << "1-3x0"
                                  << "";
        QTest::newRow("words") << "all"
                               << "";
        QTest::newRow("empty") << ""
                               << "";
        QTest::newRow("huge") << "0-999999"
                              << "";
    }

    void frameListsGoThereAndBack()
    {
        QFETCH(QString, text);
        QFETCH(QString, shortest);
        const std::optional<QVector<int>> frames = parseFrames(text);
        QCOMPARE(frames.has_value(), !shortest.isEmpty());
        QCOMPARE(formatFrames(frames.value_or(QVector<int>())), shortest);
        QVERIFY(!frames || *parseFrames(formatFrames(*frames)) == *frames);
    }

    void aFrameShowsWhatItDidUntilItsDigestIsKnown()
    {
        FrameStore store;
        const QSignalSpy shown(&store, &FrameStore::frameHashed);
        store.put(1, {sheet(0xff0000), {}}, {});
        QVERIFY(!store.isHashed(store.lastPut()));
        QTRY_VERIFY(store.isHashed(store.lastPut()));
        const QByteArray red = protocol::frameDigest(sheet(0xff0000));
        QCOMPARE(store.frames().value(1).digest, red);
        store.put(1, {sheet(0x00ff00), {}}, {});
        QCOMPARE(store.frames().value(1).digest, red);
        QTRY_COMPARE(shown.count(), 2);
        QCOMPARE(store.frames().value(1).digest, protocol::frameDigest(sheet(0x00ff00)));
        QCOMPARE(store.drawing(red).pixels, sheet(0xff0000));
    }

    void theSameDrawingAgainChangesNothing()
    {
        FrameStore store;
        const QSignalSpy shown(&store, &FrameStore::frameHashed);
        store.put(1, {sheet(0xff0000), {}}, {});
        store.put(2, {sheet(0xff0000), {}}, {});
        QTRY_COMPARE(shown.count(), 2);
        store.put(1, {sheet(0xff0000), {}}, {});
        QTRY_COMPARE(shown.count(), 3);
        QCOMPARE(shown[2], (QList<QVariant>{1, false}));
        store.put(1, {sheet(0xff0000), {}}, QTransform::fromTranslate(3, 0));
        QTRY_COMPARE(shown.count(), 4);
        QCOMPARE(shown[3], (QList<QVariant>{1, true}));
    }

    void whatIsDroppedWhileItIsHashedStaysDropped()
    {
        FrameStore store;
        store.put(1, {sheet(0xff0000, 512), {}}, {});
        store.drop(1);
        QTRY_VERIFY(store.isHashed(store.lastPut()));
        QVERIFY(store.frames().isEmpty());
    }

    void aDrawingHasTheDigestOfItsLayersToo()
    {
        FrameStore store;
        const QSignalSpy shown(&store, &FrameStore::frameHashed);
        const DrawnLayers layers = {{QStringLiteral("body"), sheet(0xff0000)},
                                    {QStringLiteral("arm"), sheet(0x00ff00)}};
        store.put(1, {sheet(0xff0000), {}}, {});
        store.put(2, {sheet(0xff0000), layers}, {});
        store.put(3, {sheet(0xff0000), {layers[1], layers[0]}}, {});
        QTRY_COMPARE(shown.count(), 3);
        const QByteArray apart = store.frames().value(2).digest;
        QVERIFY(apart != store.frames().value(1).digest);
        QVERIFY(apart != store.frames().value(3).digest);
        QCOMPARE(store.drawing(apart).layers.size(), 2);
        QCOMPARE(store.drawing(apart).layers[1].name, QStringLiteral("arm"));
        QCOMPARE(apart, protocol::frameDigest({protocol::viewOf(protocol::Role::Pixels, sheet(0xff0000)),
                                               protocol::viewOf(protocol::Role::Layer, layers[0].pixels),
                                               protocol::viewOf(protocol::Role::Layer, layers[1].pixels)},
                                              {QStringLiteral("body"), QStringLiteral("arm")}));
    }

    void theDrawingLeastLatelyUsedIsLetGo()
    {
        FrameStore store(3 * 1024 * 1024);
        const QSignalSpy shown(&store, &FrameStore::frameHashed);
        for (int frame = 1; frame <= 4; ++frame)
        {
            store.put(frame, {sheet(QRgb(0xff0000 + frame), 500), {}}, {}); // 1 MB each
            QTRY_COMPARE(shown.count(), frame);
            QVERIFY(!store.drawing(store.frames().value(1).digest).pixels.isNull());
        }
        QVERIFY(store.drawing(store.frames().value(2).digest).pixels.isNull());
        QVERIFY(!store.drawing(store.frames().value(4).digest).pixels.isNull());
    }

    void theInterpreterIsNamedByVariableThenNoteThenSourceTree()
    {
        const QTemporaryDir folder;
        qputenv("LAMPBLACK_PYTHON", "/opt/python");
        QCOMPARE(findInterpreter(folder.path()).path, QStringLiteral("/opt/python"));
        qunsetenv("LAMPBLACK_PYTHON");
        QVERIFY(findInterpreter(folder.path()).path.endsWith(QStringLiteral("/.venv/bin/python")));
        QFile note(folder.filePath(QStringLiteral("lampblack.json")));
        QVERIFY(note.open(QIODevice::WriteOnly));
        note.write("{\"python\": \"/usr/lib/lampblack/bin/python\"}");
        note.close();
        QCOMPARE(findInterpreter(folder.path()).path, QStringLiteral("/usr/lib/lampblack/bin/python"));
        QVERIFY(note.open(QIODevice::WriteOnly));
        note.write("{\"python\": [");
        note.close();
        QCOMPARE(findInterpreter(folder.path()).path, QString());
        QCOMPARE(findInterpreter(folder.path()).source, note.fileName());
    }
};

QTEST_GUILESS_MAIN(TestWorkerParts)
#include "test_parts.moc"
