// The view transform is found in memory, and the camera is interpolated between its keys.
#include "host/camera_frame.h"
#include "host/camera_path.h"
#include "host/project_watch.h"
#include "host/transport.h"
#include "host/view_reader.h"

#include <QTest>

#include <algorithm>
#include <sys/mman.h>
#include <unistd.h>

using namespace lampblack;

namespace
{

const QSize Widget(301, 510);

struct FakeView
{
    std::array<quint64, 3> before{0xdeadbeef, 1, 2};
    QTransform view, viewInverse, widget, widgetInverse, centre;
    std::array<double, 4> after{1, 2, 3, 4};
};

FakeView fakeView(double zoom, double angle, bool flipX)
{
    FakeView fake;
    fake.view = QTransform().translate(30, -7).rotate(angle).scale(zoom, zoom);
    fake.viewInverse = fake.view.inverted();
    fake.centre = QTransform::fromTranslate(Widget.width() / 2.0, Widget.height() / 2.0);
    fake.widget = fake.view * QTransform::fromScale(flipX ? -1 : 1, 1) * fake.centre;
    fake.widgetInverse = fake.widget.inverted();
    return fake;
}

QByteArray bytesOf(const FakeView& fake)
{
    return QByteArray(reinterpret_cast<const char*>(&fake), sizeof(fake));
}

} // namespace

class ViewAndCamera : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void viewIsFound()
    {
        const FakeView fake = fakeView(1.468, 33, true);
        const int offset = findMatrices(bytesOf(fake), Widget, true, false, 1.468);
        QCOMPARE(offset, int(offsetof(FakeView, view)));
        QCOMPARE(matricesAt(bytesOf(fake), offset)->widget, fake.widget);
    }

    void viewIsNotMistaken()
    {
        const QByteArray bytes = bytesOf(fakeView(1.468, 33, true));
        QCOMPARE(findMatrices(bytes, Widget, false, false, 1.468), -1);
        QCOMPARE(findMatrices(bytes, Widget, true, false, 1.5), -1);
        QCOMPARE(findMatrices(bytes, QSize(640, 480), true, false, 1.468), -1);
        QCOMPARE(findMatrices(bytes.left(300), Widget, true, false, 1.468), -1);
        QCOMPARE(findMatrices(bytes + bytes, Widget, true, false, 1.468), -1);
        QCOMPARE(findMatrices(QByteArray(1024, '\0'), Widget, false, false, 0), -1);
        QCOMPARE(findMatrices(QByteArray(1024, '\xff'), Widget, false, false, 0), -1);
        QCOMPARE(findMatrices({}, Widget, false, false, 0), -1);
    }

    void unreadableMemoryIsRefused()
    {
        const auto page = static_cast<int>(sysconf(_SC_PAGESIZE));
        void* pages = mmap(nullptr, size_t(page) * 2, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        QVERIFY(pages != MAP_FAILED);
        char* second = static_cast<char*>(pages) + page;
        QCOMPARE(mprotect(second, size_t(page), PROT_NONE), 0);
        QCOMPARE(readSafely(second - 1024, 1024).size(), 1024);
        QVERIFY(readSafely(second - 512, 1024).isEmpty());
        QVERIFY(readSafely(nullptr, 8).isEmpty());
        munmap(pages, size_t(page) * 2);
    }

    void wholeZoomsSnap()
    {
        const QTransform half(3, 0, 0, -3, 10.5, 20.25);
        QCOMPARE(snappedToPixels(half), QTransform(3, 0, 0, -3, 11, 20));
        QCOMPARE(snappedToPixels(half, 2), QTransform(3, 0, 0, -3, 10.5, 20.5));
        for (const QTransform& kept :
             {QTransform(0.33, 0, 0, 0.33, 10.5, 20.25), QTransform(0, 1, -1, 0, 0.5, 0.5)})
            QCOMPARE(snappedToPixels(kept), kept);
    }

    void zoomIsRead()
    {
        QCOMPARE(zoomOf(QStringLiteral("Zoom: 146.8%")), 1.468);
        QCOMPARE(zoomOf(QStringLiteral("Vergrößerung: 33,0 %")), 0.33);
        QCOMPARE(zoomOf(QStringLiteral("Ready")), 0.0);
    }

    void cameraStandsWhereItsPathSaysNothingElse()
    {
        const QTransform a = QTransform::fromTranslate(10, 0);
        const QTransform b(2, 0, 0, 2, 30, 8);
        const CameraPath path{{3, a}, {7, b}};
        QCOMPARE(cameraAt(path, 1), a);
        QCOMPARE(cameraAt(path, 3), a);
        QCOMPARE(cameraAt(path, 6), a);
        QCOMPARE(cameraAt(path, 7), b);
        QCOMPARE(cameraAt(path, 90), b);
        QVERIFY(cameraAt({}, 5).isIdentity());
    }

    void cameraIsReadSomeFramesAtATime_data()
    {
        QTest::addColumn<bool>("curved");
        QTest::newRow("0.6, by keys") << false;
        QTest::newRow("0.7, by frames") << true;
    }

    void cameraIsReadSomeFramesAtATime()
    {
        QFETCH(bool, curved);
        constexpr int Most = 8;
        constexpr int Length = 90;
        const QVector<int> keys{3, 20, 30, 71};
        int now = 12;
        int reads = 0;
        const auto viewAt = [](int frame)
        {
            return QTransform::fromTranslate(qBound(3, frame, 71), 0);
        };
        CameraSteps steps;
        steps.read = [&]() -> std::optional<QTransform>
        {
            ++reads;
            return viewAt(now);
        };
        steps.frame = [&]
        {
            return now;
        };
        steps.goTo = [&](int frame)
        {
            now = frame;
        };
        steps.toNextKey = [&]
        {
            const auto next = std::upper_bound(keys.begin(), keys.end(), now);
            now = next == keys.end() ? now : *next;
        };
        steps.toPreviousKey = [&]
        {
            const auto next = std::lower_bound(keys.begin(), keys.end(), now);
            now = next == keys.begin() ? now : *std::prev(next);
        };
        CameraReading reading(curved ? CameraMoves::Curved : CameraMoves::Straight, Length, steps);
        int goes = 0;
        while (!reading.isDone())
        {
            reads = 0;
            now = 12; // the artist's
            QVERIFY(reading.read(Most, 1000));
            QVERIFY(reads >= 1 && reads <= Most);
            QVERIFY(++goes <= Length);
        }
        QVERIFY(!curved || goes == 9);
        for (int frame = 1; frame <= Length; ++frame)
            QVERIFY2(areNear(cameraAt(reading.path(), frame), viewAt(frame)),
                     qPrintable(QString::number(frame)));
    }

    void cameraThatCannotBeReadIsTold()
    {
        CameraSteps steps;
        steps.read = []() -> std::optional<QTransform>
        {
            return std::nullopt;
        };
        steps.frame = []
        {
            return 1;
        };
        steps.goTo = [](int) {
        };
        steps.toNextKey = steps.toPreviousKey = [] {
        };
        QVERIFY(!CameraReading(CameraMoves::Curved, 1, steps).read(8, 1000));
    }

    void cameraIsKnownByItsFrame()
    {
        const QSize size(641, 480);
        const QPolygonF frame({{-320, -240}, {321, -240}, {321, 240}, {-320, 240}});
        const QTransform widget = QTransform(1.5, 0.2, -0.2, 1.5, 300, 210);
        for (const QTransform& view :
             {QTransform(), QTransform().rotate(170).scale(0.7, 0.7).translate(31, -8)})
        {
            const QPolygonF corners = widget.map(view.inverted().map(frame));
            const auto found = viewOfFrame(corners, widget, size);
            QVERIFY(found && areNear(*found, view));
            QCOMPARE(found->isIdentity(), view.isIdentity());
            QPolygonF bent = corners;
            bent[2].rx() += 1;
            QVERIFY(!viewOfFrame(bent, widget, size));
        }
        QVERIFY(!viewOfFrame(QPolygonF({{0, 0}, {0, 0}, {0, 0}, {0, 0}}), widget, size));
        QVERIFY(!viewOfFrame(QPolygonF(), widget, size));
    }

    void cameraTurnsAboutThePicturesCentre()
    {
        const QSize size(641, 480);
        const QTransform turned = canvasToImage(QTransform().rotate(90).scale(2, 2), size);
        QCOMPARE(turned.map(originIn(size)), originIn(size));
        QCOMPARE(turned.map(originIn(size) + QPointF(10, 0)), originIn(size) + QPointF(0, 20));
        QVERIFY(canvasToImage(QTransform(), size).isIdentity());
    }

    void titlesNameProjects_data()
    {
        QTest::addColumn<QString>("title");
        QTest::addColumn<QString>("path");
        QTest::newRow("project") << QStringLiteral("[*]/shots/a walk.pclx")
                                 << QStringLiteral("/shots/a walk.pclx");
        QTest::newRow("old format") << QStringLiteral("[*]/shots/walk.pcl")
                                    << QStringLiteral("/shots/walk.pcl");
        QTest::newRow("untitled") << QStringLiteral("[*]Pencil2D 0.6.6") << QString();
        QTest::newRow("nightly") << QStringLiteral("[*]Pencil2D Nightly Build Aug/16/2022") << QString();
        QTest::newRow("empty") << QStringLiteral("[*]") << QString();
    }

    void titlesNameProjects()
    {
        QFETCH(QString, title);
        QTEST(projectOf(title), "path");
    }

    void timeLabelsNameFrames()
    {
        QCOMPARE(frameOf(QStringLiteral("0012")), 12);
        QCOMPARE(frameOf(QStringLiteral("00:01:03 | 0015")), 15);
        QCOMPARE(frameOf(QStringLiteral("00:01:03")), 0);
        QCOMPARE(frameOf(QString()), 0);
    }
};

QTEST_APPLESS_MAIN(ViewAndCamera)
#include "test_view_and_camera.moc"
