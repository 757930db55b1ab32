// WorkerSession with the real worker, if LAMPBLACK_PYTHON names an interpreter that has it.
#include "worker/worker_session.h"

#include <QElapsedTimer>
#include <QPainter>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

#include <algorithm>
#include <csignal>

using namespace lampblack;

namespace
{

constexpr int Side = 160;
constexpr int PatienceMs = 90000;

QImage ball()
{
    QImage image(Side, Side, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(Qt::black, 3));
    painter.setBrush(QColor(220, 120, 60));
    painter.drawEllipse(QPointF(Side / 2.0, Side / 2.0), Side * 0.4, Side * 0.4);
    return image;
}

Scene litFrom(double x)
{
    Scene scene = defaultScene(QSize(Side, Side));
    scene.lights[0].x = x;
    scene.lights[0].y = Side / 2.0;
    return scene;
}

/// Mean lightness of the left half of the ball over that of its right half.
double leftOverRight(const QImage& picture)
{
    double left = 0;
    double right = 0;
    const int middle = picture.height() / 2;
    for (int x = picture.width() / 5; x < picture.width() * 4 / 5; ++x)
    {
        (x < picture.width() / 2 ? left : right) += picture.pixelColor(x, middle).lightnessF();
    }
    return left / right;
}

} // namespace

class TestRealWorker : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        if (qEnvironmentVariable("LAMPBLACK_PYTHON").isEmpty())
        {
            QSKIP("LAMPBLACK_PYTHON names no interpreter");
        }
        qputenv("XDG_CACHE_HOME", mCache.path().toLocal8Bit());
        mSession = std::make_unique<WorkerSession>();
        connect(mSession.get(), &Worker::imageArrived, this,
                [this](const PreviewImage& image) { mImage = image; });
        connect(mSession.get(), &Worker::problem, this,
                [](const UserError& error) { qWarning() << error.what << error.details; });
        mSession->start();
        mSession->putFrame(1, ball());
    }

    void lightFallsFromWhereTheLampStands()
    {
        QCOMPARE(mSession->state(), Worker::State::Starting);
        show(20);
        const double fromLeft = leftOverRight(mImage.picture);
        show(Side - 20);
        const double fromRight = leftOverRight(mImage.picture);
        QVERIFY2(fromLeft > 1.1 && fromRight < 0.9,
                 qPrintable(QStringLiteral("%1 %2").arg(fromLeft).arg(fromRight)));
        const QString folder = qEnvironmentVariable("LAMPBLACK_TEST_PICTURES");
        if (!folder.isEmpty())
        {
            mImage.picture.save(folder + QStringLiteral("/from_right.png"));
        }
    }

    void aDragIsFollowed()
    {
        QSignalSpy image(mSession.get(), &Worker::imageArrived);
        QVector<qint64> times;
        for (int step = 0; step < 40; ++step)
        {
            QElapsedTimer clock;
            clock.start();
            mSession->setScene(litFrom(30 + step * 2));
            while (!mSession->isCurrent(mImage))
            {
                QVERIFY(image.wait(PatienceMs));
            }
            times.append(clock.elapsed());
        }
        std::sort(times.begin(), times.end());
        qInfo("setScene to imageArrived: median %lld ms, 90%% %lld ms", times[20], times[36]);
    }

    void itsPaletteIsThatOfTheDrawing()
    {
        const QSignalSpy palette(mSession.get(), &Worker::paletteArrived);
        mSession->requestPalette(1);
        QTRY_COMPARE_WITH_TIMEOUT(palette.count(), 1, PatienceMs);
        QCOMPARE(palette[0][1].value<QVector<Swatch>>().value(0).colour, QStringLiteral("#dc783c"));
    }

    void framesAreRenderedToFiles()
    {
        const QTemporaryDir folder;
        const QSignalSpy done(mSession.get(), &Worker::renderDone);
        const quint64 job = mSession->render(QStringLiteral("1"),
                                             folder.filePath(QStringLiteral("a.%04d.png")), Quality::Low);
        QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, PatienceMs);
        QCOMPARE(done[0], (QList<QVariant>{job, QStringLiteral("finished"), 1, 1, 0}));
        QCOMPARE(QImage(folder.filePath(QStringLiteral("a.0001.png"))).size(), QSize(Side, Side));
    }

    void killedItReturnsWithThePicture()
    {
        kill(static_cast<pid_t>(mSession->workerPid()), SIGKILL);
        QTRY_COMPARE(mSession->state(), Worker::State::Restarting);
        mImage = {};
        QTRY_VERIFY_WITH_TIMEOUT(mSession->isCurrent(mImage), PatienceMs);
        QTRY_VERIFY_WITH_TIMEOUT(mSession->state() == Worker::State::Ready ||
                                     mSession->state() == Worker::State::Busy,
                                 PatienceMs);
    }

    void cleanupTestCase() { mSession.reset(); }

private:
    void show(double x)
    {
        mSession->setScene(litFrom(x));
        mSession->requestPreview(1, Show::Lit, QRectF(0, 0, Side, Side), QSize(Side, Side));
        QTRY_VERIFY_WITH_TIMEOUT(mSession->isCurrent(mImage) && mImage.converged, PatienceMs);
    }

    QTemporaryDir mCache;
    std::unique_ptr<WorkerSession> mSession;
    PreviewImage mImage;
};

QTEST_GUILESS_MAIN(TestRealWorker)
#include "test_tracing.moc"
