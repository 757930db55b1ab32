// Render jobs of a WorkerSession, with a worker process that follows a script.
#include "support/session_test.h"

#include <QSignalSpy>

#include <algorithm>

using namespace lampblack;

class SessionJobsTest : public SessionTest
{
    Q_OBJECT

private Q_SLOTS:
    void aRenderIsTakenApart()
    {
        const auto session = open("good");
        lookAtOne(*session);
        const QSignalSpy done(session.get(), &Worker::renderDone);
        session->render(QStringLiteral("1"), QStringLiteral("/tmp/a.%04d.exr"), Quality::Low, {},
                        ApartKind::Exr);
        QTRY_COMPARE(done.count(), 1);
        const QList<QJsonObject> headers = received();
        const auto render =
            std::find_if(headers.begin(), headers.end(),
                         [](const QJsonObject& header)
                         { return header.value(QLatin1String("type")) == QLatin1String("render"); });
        QVERIFY(render != headers.end());
        QCOMPARE(render->value(QLatin1String("apart")).toString(), QStringLiteral("exr"));
    }

    void aRenderIsFinishedByTheNextWorker()
    {
        const auto session = open("dies_rendering");
        lookAtOne(*session);
        session->putFrame(2, sheet(Qt::green));
        session->putFrame(3, sheet(Qt::blue));
        const QSignalSpy frameDone(session.get(), &Worker::renderFrameDone);
        const QSignalSpy done(session.get(), &Worker::renderDone);
        const quint64 job =
            session->render(QStringLiteral("1-3"), QStringLiteral("/tmp/a.%04d.png"), Quality::Final);
        session->setScene(sceneLitFrom(7));
        QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, 10000);
        QCOMPARE(done[0], (QList<QVariant>{job, QStringLiteral("finished"), 3, 3, 0}));
        QCOMPARE(frameDone.count(), 1);
        QStringList asked;
        QVector<double> under;
        double light = -1;
        const QList<QJsonObject> headers = received();
        for (const QJsonObject& header : headers)
        {
            const QString type = header.value(QLatin1String("type")).toString();
            if (type == QLatin1String("set_scene"))
            {
                light = header[QStringLiteral("scene")][QStringLiteral("lights")][0][QStringLiteral("x")]
                            .toDouble();
            }
            if (type == QLatin1String("render"))
            {
                asked.append(header.value(QLatin1String("frames")).toString());
                under.append(light);
            }
        }
        QCOMPARE(asked, (QStringList{QStringLiteral("1-3"), QStringLiteral("2-3")}));
        QCOMPARE(under, (QVector<double>{1, 1})); // the scene as it was when it was asked for
        QCOMPARE(light, 7.0);
    }

    void aRefusedRenderEnds_data()
    {
        QTest::addColumn<QString>("frames");
        QTest::addColumn<QString>("output");
        QTest::newRow("no frames") << ""
                                   << "/tmp/a.%04d.png";
        QTest::newRow("not a pattern") << "1"
                                       << "/tmp/a.png";
        QTest::newRow("relative") << "1"
                                  << "a.%04d.png";
        QTest::newRow("two numbers") << "1"
                                     << "/tmp/%d.%04d.png";
        QTest::newRow("by the worker") << "404"
                                       << "/tmp/a.%04d.png";
    }

    void aRefusedRenderEnds()
    {
        QFETCH(QString, frames);
        QFETCH(QString, output);
        const auto session = open("good");
        lookAtOne(*session);
        const QSignalSpy done(session.get(), &Worker::renderDone);
        const quint64 job = session->render(frames, output, Quality::Low);
        QCOMPARE(done.count(), 0);
        QTRY_COMPARE(done.count(), 1);
        QCOMPARE(done[0][0].toULongLong(), job);
        QCOMPARE(done[0][1].toString(), QStringLiteral("failed"));
        QTRY_COMPARE(mProblems.size(), 1);
    }
};

QTEST_GUILESS_MAIN(SessionJobsTest)
#include "test_session_jobs.moc"
